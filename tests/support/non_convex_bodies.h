// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/support/dem_scenes.h"
#include "tests/support/solids.h"

namespace test_support {

/// Bodies as partitions into convex parts, in more than one cut.
using Parts = std::vector<catalog::ConvexPart>;

struct BoxCorners {
  catalog::Point low, high;
};

/// Partition into boxes. Each face is split along the planes of the other boxes' faces into covered (inner) and bare
/// (outer) rectangles.
inline Parts boxes_body(const std::vector<BoxCorners>& boxes) {
  Parts parts;
  for (const BoxCorners& box : boxes) {
    catalog::ConvexPart part = box_part(box.low, box.high);
    part.faces.clear();
    const auto vertex = [&](const catalog::Point& p) {
      const auto found = std::find(part.vertices.begin(), part.vertices.end(), p);
      if (found != part.vertices.end()) return static_cast<int>(found - part.vertices.begin());
      part.vertices.push_back(p);
      return static_cast<int>(part.vertices.size()) - 1;
    };
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const auto cuts = [&](int along) {
          std::vector<double> at{box.low[along], box.high[along]};
          for (const BoxCorners& other : boxes)
            for (const double x : {other.low[along], other.high[along]})
              if (x > box.low[along] && x < box.high[along]) at.push_back(x);
          std::sort(at.begin(), at.end());
          at.erase(std::unique(at.begin(), at.end()), at.end());
          return at;
        };
        const std::vector<double> us = cuts(u), vs = cuts(v);
        for (std::size_t i = 1; i < us.size(); ++i)
          for (std::size_t j = 1; j < vs.size(); ++j) {
            const double height = side > 0 ? box.high[axis] : box.low[axis];
            const auto corner = [&](double x, double y) {
              catalog::Point p;
              p[axis] = height;
              p[u] = x;
              p[v] = y;
              return p;
            };
            std::vector<int> loop{vertex(corner(us[i - 1], vs[j - 1])), vertex(corner(us[i], vs[j - 1])),
                                  vertex(corner(us[i], vs[j])), vertex(corner(us[i - 1], vs[j]))};
            if (side < 0) std::reverse(loop.begin(), loop.end());
            catalog::Point normal{0, 0, 0};
            normal[axis] = side;
            const catalog::Point middle = corner((us[i - 1] + us[i]) / 2, (vs[j - 1] + vs[j]) / 2);
            const bool is_covered = std::any_of(boxes.begin(), boxes.end(), [&](const BoxCorners& other) {
              for (const int a : {u, v})
                if (middle[a] < other.low[a] || middle[a] > other.high[a]) return false;
              return (side > 0 ? other.low[axis] : other.high[axis]) == height;
            });
            part.faces.push_back(
                {loop, {normal, side * height}, is_covered ? catalog::FaceKind::inner : catalog::FaceKind::outer});
          }
      }
    parts.push_back(std::move(part));
  }
  return parts;
}

inline Parts l_in_2() { return boxes_body({{{0, 0, 0}, {2, 1, 1}}, {{0, 1, 0}, {1, 2, 1}}}); }
inline Parts l_in_3() { return boxes_body({{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}, {{0, 1, 0}, {1, 2, 1}}}); }
inline Parts l_in_6() {
  return boxes_body({{{0, 0, 0}, {0.3, 2, 1}},
                     {{0.3, 1, 0}, {1, 2, 0.5}},
                     {{0.3, 1, 0.5}, {1, 2, 1}},
                     {{0.3, 0, 0}, {1.25, 0.75, 1}},
                     {{0.3, 0.75, 0}, {1.25, 1, 1}},
                     {{1.25, 0, 0}, {2, 1, 1}}});
}
inline Parts cross_in_3() {
  return boxes_body({{{0, 1, 0}, {3, 2, 1}}, {{1, 0, 0}, {2, 1, 1}}, {{1, 2, 0}, {2, 3, 1}}});
}
inline Parts cross_in_5() {
  return boxes_body({{{1, 1, 0}, {2, 2, 1}},
                     {{0, 1, 0}, {1, 2, 1}},
                     {{2, 1, 0}, {3, 2, 1}},
                     {{1, 0, 0}, {2, 1, 1}},
                     {{1, 2, 0}, {2, 3, 1}}});
}
inline Parts u_in_3() { return boxes_body({{{0, 0, 0}, {3, 1, 1}}, {{0, 1, 0}, {1, 3, 1}}, {{2, 1, 0}, {3, 3, 1}}}); }
inline Parts u_in_5() {
  return boxes_body({{{0, 0, 0}, {1, 2, 1}},
                     {{0, 2, 0}, {1, 3, 1}},
                     {{1, 0, 0}, {2, 1, 1}},
                     {{2, 0, 0}, {3, 1.5, 1}},
                     {{2, 1.5, 0}, {3, 3, 1}}});
}
/// Six square arms, thinner than the cube they stand on.
inline Parts hexapod() {
  return boxes_body({{{-1, -1, -1}, {1, 1, 1}},
                     {{1, -0.5, -0.5}, {2, 0.5, 0.5}},
                     {{-2, -0.5, -0.5}, {-1, 0.5, 0.5}},
                     {{-0.5, 1, -0.5}, {0.5, 2, 0.5}},
                     {{-0.5, -2, -0.5}, {0.5, -1, 0.5}},
                     {{-0.5, -0.5, 1}, {0.5, 0.5, 2}},
                     {{-0.5, -0.5, -2}, {0.5, 0.5, -1}}});
}
/// The same with the cube in two and one arm running through it.
inline Parts hexapod_cut_otherwise() {
  return boxes_body({{{-1, -1, -1}, {1, -0.5, 1}},
                     {{-1, 0.5, -1}, {1, 1, 1}},
                     {{-2, -0.5, -0.5}, {2, 0.5, 0.5}},
                     {{-1, -0.5, 0.5}, {1, 0.5, 1}},
                     {{-1, -0.5, -1}, {1, 0.5, -0.5}},
                     {{-0.5, 1, -0.5}, {0.5, 2, 0.5}},
                     {{-0.5, -2, -0.5}, {0.5, -1, 0.5}},
                     {{-0.5, -0.5, 1}, {0.5, 0.5, 2}},
                     {{-0.5, -0.5, -2}, {0.5, 0.5, -1}}});
}

/// Prisms of height 1 over convex polygons (counter-clockwise) that tile a region edge to edge.
inline Parts prisms_body(const std::vector<std::vector<std::array<double, 2>>>& tiles) {
  Parts parts;
  for (const auto& tile : tiles) {
    const int n = static_cast<int>(tile.size());
    std::vector<Vec3> vertices;
    std::vector<std::vector<int>> loops(2);
    for (const double z : {0.0, 1.0})
      for (const auto& [x, y] : tile) vertices.push_back({x, y, z});
    for (int i = 0; i < n; ++i) {
      loops[0].insert(loops[0].begin(), i);
      loops[1].push_back(n + i);
      loops.push_back({i, (i + 1) % n, n + (i + 1) % n, n + i});
    }
    catalog::ConvexPart part = part_of(vertices, loops);
    for (int i = 0; i < n; ++i)
      for (const auto& other : tiles)
        for (std::size_t k = 0; k < other.size(); ++k)
          if (other[k] == tile[static_cast<std::size_t>((i + 1) % n)] &&
              other[(k + 1) % other.size()] == tile[static_cast<std::size_t>(i)])
            part.faces[static_cast<std::size_t>(2 + i)].kind = catalog::FaceKind::inner;
    parts.push_back(std::move(part));
  }
  return parts;
}

/// A stem with two arms that slant up (re-entrant by 40 degrees) and down (by 130 degrees: an acute notch).
inline Parts slanted_t(bool cut_otherwise) {
  using P = std::array<double, 2>;
  const P a{-0.4, 0}, b{0.4, 0}, c{0.4, 1.8}, d{-0.4, 1.8}, e{-0.4, 1.3}, f{0.4, 1.3};
  const P left_low{-1.5, 2.2}, left_high{-1.5, 2.7};    // slants up from the stem
  const P right_low{1.3, 0.55}, right_high{1.3, 1.05};  // slants down
  const P top{0.1, 1.8};
  if (!cut_otherwise)
    return prisms_body({{a, b, f, c, d, e}, {left_low, e, d, left_high}, {f, right_low, right_high, c}});
  return prisms_body({{a, b, f, e},
                      {e, f, top, d},
                      {f, c, top},
                      {left_low, e, d},
                      {left_low, d, left_high},
                      {f, right_low, right_high, c}});
}

/// A rough rock about its centre, one part a triangle of the surface; cut otherwise, each triangle and part in two.
inline Parts star_rock(const std::function<double(const catalog::Point&)>& radius, int levels, bool cut_otherwise) {
  const catalog::TriangleMesh mesh = solids::star(radius, levels);
  Parts parts;
  for (const auto& triangle : mesh.faces) {
    const auto at = [&](int i) { return to_vec3(mesh.vertices[static_cast<std::size_t>(i)]); };
    const Vec3 a = at(triangle[0]), b = at(triangle[1]), c = at(triangle[2]);
    const auto add = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
      catalog::ConvexPart part = part_of({{}, p, q, r}, {{1, 2, 3}, {0, 2, 1}, {0, 3, 2}, {0, 1, 3}});
      for (int face = 1; face < 4; ++face) part.faces[static_cast<std::size_t>(face)].kind = catalog::FaceKind::inner;
      parts.push_back(std::move(part));
    };
    if (cut_otherwise) {
      const Vec3 middle = 0.6 * a + 0.4 * b;
      add(a, middle, c);
      add(middle, b, c);
    } else {
      add(a, b, c);
    }
  }
  return parts;
}

/// Bumps of about a fifth of the radius; pits and saddles among them.
inline double bumpy_radius(const catalog::Point& p) {
  return 1 + 0.12 * std::sin(4 * p[0] + 1) * std::cos(5 * p[1]) + 0.1 * std::sin(6 * p[2] + 2 * p[0]);
}

}  // namespace test_support
