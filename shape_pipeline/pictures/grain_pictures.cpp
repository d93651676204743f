// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/grain_pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "shape_pipeline/surfaces/vector3.h"

namespace shape_pipeline {
namespace {

constexpr Colour kBackground{255, 255, 255}, kStone{203, 191, 168}, kInside{226, 122, 58}, kNoValue{158, 158, 158};
constexpr Colour kNear{28, 62, 104}, kFar{188, 204, 220};
constexpr int kSupersampling = 2;                      // drawn this many times larger and averaged: smooth edges
constexpr double kMargin = 1.04;                       // of the ball that is shown
constexpr double kAmbient = 0.25, kMapAmbient = 0.65;  // share of a colour that shows whatever the light
constexpr double kKeyLight = 0.6;                      // share of the rest that comes from the upper left
constexpr double kDotRadius = 0.4;  // over the mean distance of the points that a ball would show on one side
constexpr double kLargestDot = 8;   // radius [pixels of the canvas]

/// A camera without perspective: columns along `right`, rows against `up`, depth growing towards the eye.
struct Camera {
  Point right, up, towards_eye;
};

/// From the front, above, and a little to the left, or from the opposite point. The longest axis of a shape is x, the
/// shortest z.
Camera camera(bool is_behind) {
  const Point front = normalized({-0.35, -0.8, 0.62});
  Camera result;
  result.towards_eye = scaled(front, is_behind ? -1 : 1);
  result.right = normalized(cross({0, 0, 1}, result.towards_eye));
  result.up = cross(result.towards_eye, result.right);
  return result;
}

struct Pixel {
  double x = 0, y = 0, depth = 0;
};

/// One of the two views, with the nearest depth met at each pixel.
class Canvas {
 public:
  Canvas(const GrainView& view, bool is_behind)
      : camera_(camera(is_behind)),
        centre_(view.centre),
        scale_(0.5 * kSupersampling * view.side / (kMargin * view.radius)),
        image_(kSupersampling * view.side, kSupersampling * view.side, kBackground),
        depths_(image_.pixels.size(), -std::numeric_limits<double>::infinity()) {}

  Pixel seen(const Point& point) const {
    const Point arm = subtract(point, centre_);
    const double middle = 0.5 * image_.width;
    return {middle + scale_ * dot(camera_.right, arm), middle - scale_ * dot(camera_.up, arm),
            scale_ * dot(camera_.towards_eye, arm)};
  }
  double half_depth() const { return 0.5 * image_.width; }

  void put(int x, int y, double depth, const Colour& colour) {
    if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
    double& nearest =
        depths_[static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x)];
    if (depth <= nearest) return;
    nearest = depth;
    image_(x, y) = colour;
  }

  /// `colour_at` takes the weights of the three corners.
  void fill(const std::array<Pixel, 3>& p, const std::function<Colour(const std::array<double, 3>&)>& colour_at) {
    const double twice_area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (twice_area == 0) return;
    const auto [low_x, high_x] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [low_y, high_y] = std::minmax({p[0].y, p[1].y, p[2].y});
    const auto first = [](double low) { return static_cast<int>(std::max(0.0, std::ceil(low - 0.5))); };
    const auto last = [&](double high) { return static_cast<int>(std::min(image_.width - 1.0, high - 0.5)); };
    for (int y = first(low_y); y <= last(high_y); ++y)
      for (int x = first(low_x); x <= last(high_x); ++x) {
        std::array<double, 3> weight;
        for (std::size_t k = 0; k < 3; ++k) {
          const Pixel &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
          weight[k] = ((b.x - a.x) * (y + 0.5 - a.y) - (x + 0.5 - a.x) * (b.y - a.y)) / twice_area;
        }
        if (weight[0] < 0 || weight[1] < 0 || weight[2] < 0) continue;
        put(x, y, weight[0] * p[0].depth + weight[1] * p[1].depth + weight[2] * p[2].depth, colour_at(weight));
      }
  }

  /// Light on a face of that normal, on the side that is seen: from the upper left and from the eye. 0 to 1.
  double light(const Point& normal, double ambient) const {
    const Point source =
        normalized(add(add(scaled(camera_.right, -0.5), scaled(camera_.up, 0.7)), scaled(camera_.towards_eye, 0.5)));
    const double facing = dot(normal, camera_.towards_eye), side = facing < 0 ? -1 : 1;
    return ambient +
           (1 - ambient) * (kKeyLight * std::max(0.0, side * dot(normal, source)) + (1 - kKeyLight) * std::abs(facing));
  }
  bool is_seen_from_behind(const Point& normal) const { return dot(normal, camera_.towards_eye) < 0; }
  ColourImage finished() const { return shrunk(image_, kSupersampling); }

 private:
  Camera camera_;
  Point centre_;
  double scale_;  // [pixels/m]
  ColourImage image_;
  std::vector<double> depths_;
};

ColourImage both_sides(const GrainView& view, const std::function<void(Canvas&)>& draw) {
  std::vector<ColourImage> sides;
  for (const bool is_behind : {false, true}) {
    Canvas canvas(view, is_behind);
    draw(canvas);
    sides.push_back(canvas.finished());
  }
  return side_by_side(sides, 0);
}

const Colour kBlack{0, 0, 0};

/// Draws the faces; `colour_at` takes a face and the weights of its corners.
void draw_faces(Canvas& canvas, const catalog::TriangleMesh& mesh,
                const std::function<Colour(const catalog::Triangle&, const std::array<double, 3>&)>& colour_at,
                bool marks_inside, double ambient) {
  for (const catalog::Triangle& face : mesh.faces) {
    std::array<Pixel, 3> corners;
    std::array<Point, 3> points;
    for (std::size_t k = 0; k < 3; ++k) {
      points[k] = mesh.vertices[static_cast<std::size_t>(face[k])];
      corners[k] = canvas.seen(points[k]);
    }
    const Point normal = normalized(cross(subtract(points[1], points[0]), subtract(points[2], points[0])));
    const double light = canvas.light(normal, ambient);
    const bool is_inside = marks_inside && canvas.is_seen_from_behind(normal);
    canvas.fill(corners, [&](const std::array<double, 3>& weight) {
      return mixed(kBlack, is_inside ? kInside : colour_at(face, weight), light);
    });
  }
}

}  // namespace

GrainView view_of(const std::vector<Point>& points, int side, double share) {
  GrainView view;
  view.side = side;
  if (points.empty()) return view;
  const auto cut = static_cast<std::ptrdiff_t>(0.5 * (1 - share) * static_cast<double>(points.size()));
  std::vector<double> values(points.size());
  const auto ranked = [&](std::ptrdiff_t rank) {
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
  };
  const auto last = static_cast<std::ptrdiff_t>(points.size()) - 1;
  for (std::size_t i = 0; i < 3; ++i) {
    std::transform(points.begin(), points.end(), values.begin(), [&](const Point& p) { return p[i]; });
    view.centre[i] = 0.5 * (ranked(cut) + ranked(last - cut));
  }
  std::transform(points.begin(), points.end(), values.begin(),
                 [&](const Point& p) { return distance(p, view.centre); });
  view.radius = ranked(last - cut);
  return view;
}

ColourImage drawn_surface(const catalog::TriangleMesh& mesh, const GrainView& view) {
  return both_sides(view, [&](Canvas& canvas) {
    draw_faces(
        canvas, mesh, [](const catalog::Triangle&, const std::array<double, 3>&) { return kStone; }, true, kAmbient);
  });
}

ColourImage drawn_points(const std::vector<Point>& points, const GrainView& view) {
  const double radius = 0.5 * kSupersampling * view.side, shown = 0.5 * static_cast<double>(points.size()) + 1;
  const double spacing = radius * std::sqrt(std::numbers::pi / shown);
  const int reach = static_cast<int>(std::clamp(kDotRadius * spacing, 1.0, kLargestDot));
  return both_sides(view, [&](Canvas& canvas) {
    for (const Point& point : points) {
      const Pixel middle = canvas.seen(point);
      const Colour colour = mixed(kFar, kNear, 0.5 + 0.5 * middle.depth / canvas.half_depth());
      if (!(std::abs(middle.x) < 1e6 && std::abs(middle.y) < 1e6)) continue;
      const int x = static_cast<int>(std::floor(middle.x)), y = static_cast<int>(std::floor(middle.y));
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
          if (i * i + j * j <= reach * reach) canvas.put(x + i, y + j, middle.depth, colour);
    }
  });
}

ColourImage drawn_map(const catalog::TriangleMesh& mesh, const std::vector<double>& values, double range,
                      const GrainView& view) {
  const auto colour_at = [&](const catalog::Triangle& face, const std::array<double, 3>& weight) {
    double value = 0;
    for (std::size_t k = 0; k < 3; ++k) value += weight[k] * values[static_cast<std::size_t>(face[k])];
    if (!std::isfinite(value)) return kNoValue;
    return deviation_colour(range > 0 ? value / range : 0);
  };
  return both_sides(view, [&](Canvas& canvas) { draw_faces(canvas, mesh, colour_at, false, kMapAmbient); });
}

Colour deviation_colour(double share) {
  constexpr Colour kMiddle{247, 247, 247}, kLow{33, 92, 172}, kHigh{184, 24, 43};
  return mixed(kMiddle, share < 0 ? kLow : kHigh, std::abs(share));
}

std::vector<Point> in_shape_frame(const catalog::SourceFrame& frame, std::vector<Point> points) {
  for (Point& point : points) {
    const Point arm = subtract(point, frame.origin);
    for (std::size_t i = 0; i < 3; ++i) point[i] = frame.scale * dot(frame.axes[i], arm);
  }
  return points;
}

std::vector<Point> in_source_frame(const catalog::SourceFrame& frame, std::vector<Point> points) {
  for (Point& point : points) {
    Point there = frame.origin;
    for (std::size_t i = 0; i < 3; ++i) there = add(there, scaled(frame.axes[i], point[i] / frame.scale));
    point = there;
  }
  return points;
}

}  // namespace shape_pipeline
