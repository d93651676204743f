// SPDX-License-Identifier: Apache-2.0
#include "dem_gpu/shapes/depth_field.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "dem_gpu/shapes/convex_cell.h"

namespace dem_gpu {
namespace {

/// How far a part's field may be off the canonical one, as a share of the body's size: rounding.
constexpr Real kFieldTolerance = 1e-11;
/// Points nearer to a plane than this share of the size lie on it.
constexpr Real kOnPlane = 1e-13;
/// A proof that needs more cells than this is given up: the planes in question stay.
constexpr int kMostCells = 2000;

std::vector<Vec3> corners_of(const catalog::ConvexPart& part) {
  std::vector<Vec3> corners;
  for (const catalog::Point& p : part.vertices) corners.push_back({p[0], p[1], p[2]});
  return corners;
}

bool lies_behind(const std::vector<Vec3>& corners, const HalfSpace& plane, Real size) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Vec3& corner) { return depth_below(plane, corner) >= -1e-9 * size; });
}

/// depth below a - depth below b, as the depth below one plane.
HalfSpace difference(const HalfSpace& a, const HalfSpace& b) { return {a.normal - b.normal, a.offset - b.offset}; }

HalfSpace raised(HalfSpace plane, Real by) {
  plane.offset += by;
  return plane;
}

HalfSpace constant_depth(Real depth) { return {Vec3{}, depth}; }

/// A term of the field that a part is compared with.
struct FieldTerm {
  Real floor;         // no point of the part is less deep below it
  std::size_t order;  // of terms equally deep the first counts
  std::vector<HalfSpace> planes;
};
/// By floor, ascending: the terms that are least at a point come early.
using Field = std::vector<FieldTerm>;

/// Writes the body's field for one part.
class PartWriter {
 public:
  PartWriter(const catalog::ConvexPart& part, Real size, Real cap)
      : corners_(corners_of(part)), cell_(convex_cell(part)), size_(size), cap_(cap) {}

  PartDepthField write(std::vector<const SurfaceTerm*> ordered) {
    std::erase_if(ordered, [&](const SurfaceTerm* term) { return lower_bound(term->planes) >= cap_; });
    std::vector<const GreatestDepth*> in_order;
    for (const SurfaceTerm* term : ordered) in_order.push_back(&term->planes);
    const Field field = by_floor(in_order);
    std::vector<GreatestDepth> terms;
    for (const SurfaceTerm* term : ordered) add_new(terms, reduced(*term, field));
    drop_dominated(terms);
    drop_redundant(terms);
    PartDepthField result;
    for (GreatestDepth& term : terms)
      if (term.size() == 1)
        result.planes.push_back(term[0]);
      else
        result.greatest.push_back(std::move(term));
    return result;
  }

 private:
  /// No corner of the part is less deep below the term than this.
  Real lower_bound(const GreatestDepth& planes) const {
    Real bound = -std::numeric_limits<Real>::max();
    for (const HalfSpace& plane : planes) {
      Real least = std::numeric_limits<Real>::max();
      for (const Vec3& corner : corners_) least = std::min(least, depth_below(plane, corner));
      bound = std::max(bound, least);
    }
    return bound;
  }

  Field by_floor(const std::vector<const GreatestDepth*>& terms) const {
    Field field;
    for (const GreatestDepth* term : terms) field.push_back({lower_bound(*term), field.size(), *term});
    std::stable_sort(field.begin(), field.end(),
                     [](const FieldTerm& a, const FieldTerm& b) { return a.floor < b.floor; });
    return field;
  }

  /// The term that is least at a point of the part. Whichever `guess` is tried first, it is the same.
  const FieldTerm* least_at(const Vec3& point, const Field& field, const FieldTerm* guess) const {
    const FieldTerm* least = guess;
    Real least_depth = guess ? greatest_depth(guess->planes, point) : std::numeric_limits<Real>::max();
    for (const FieldTerm& term : field) {
      // Floors are taken at the corners, rounded otherwise than the depth at the point.
      if (least && term.floor > least_depth + kFieldTolerance * size_) break;
      Real depth = -std::numeric_limits<Real>::max();
      for (const HalfSpace& plane : term.planes) {
        depth = std::max(depth, depth_below(plane, point));
        if (depth > least_depth) break;
      }
      if (depth < least_depth || (depth == least_depth && term.order < least->order))
        least_depth = depth, least = &term;
    }
    return least;
  }

  /// depth below a >= depth below b all over the part.
  bool is_deeper(const HalfSpace& a, const HalfSpace& b) const {
    return std::all_of(corners_.begin(), corners_.end(), [&](const Vec3& corner) {
      return depth_below(a, corner) >= depth_below(b, corner) - kOnPlane * size_;
    });
  }

  void add_new(std::vector<GreatestDepth>& terms, GreatestDepth term) const {
    const auto contains = [&](const GreatestDepth& planes, const HalfSpace& plane) {
      return std::any_of(planes.begin(), planes.end(),
                         [&](const HalfSpace& known) { return is_same_plane(known, plane, size_); });
    };
    for (const GreatestDepth& known : terms)
      if (known.size() == term.size() &&
          std::all_of(term.begin(), term.end(), [&](const HalfSpace& plane) { return contains(known, plane); }))
        return;
    terms.push_back(std::move(term));
  }

  /// True if in `region` the field is nowhere above the depth below `level`: cell by cell, each time taking away what
  /// the term that is least at a point inside accounts for.
  bool is_nowhere_above(const ConvexCell& region, const HalfSpace& level, const Field& field) const {
    const HalfSpace limit = raised(level, kFieldTolerance * size_);
    std::vector<ConvexCell> cells;
    if (!region.empty()) cells.push_back(region);
    const FieldTerm* least = nullptr;
    for (int count = 0; !cells.empty(); ++count) {
      if (count == kMostCells) return false;
      ConvexCell cell = std::move(cells.back());
      cells.pop_back();
      const Vec3 point = inner_point(cell);
      least = least_at(point, field, least);
      if (!least || greatest_depth(least->planes, point) > depth_below(limit, point)) return false;
      for (const HalfSpace& plane : least->planes) {
        ConvexCell beyond = clipped(cell, difference(plane, limit), kOnPlane * size_);
        if (beyond.empty()) continue;
        cells.push_back(std::move(beyond));
        cell = clipped(cell, difference(limit, plane), kOnPlane * size_);
        if (cell.empty()) break;
      }
    }
    return true;
  }

  /// True if the greatest depth below `planes` is nowhere in the part below the (capped) field.
  bool is_nowhere_below(const GreatestDepth& planes, const Field& field) const {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      ConvexCell region = clipped(cell_, difference(constant_depth(cap_), planes[i]), kOnPlane * size_);
      for (std::size_t k = 0; k < planes.size() && !region.empty(); ++k)
        if (k != i) region = clipped(region, difference(planes[i], planes[k]), kOnPlane * size_);
      if (!is_nowhere_above(region, planes[i], field)) return false;
    }
    return true;
  }

  /// The term with as few planes as leave the field as it is. Fewer planes only lower a term, and each reduced term is
  /// compared with the whole field, so all terms may be reduced at once.
  GreatestDepth reduced(const SurfaceTerm& term, const Field& field) const {
    const HalfSpace& own = term.planes[0];
    if (is_nowhere_below({own}, field)) return {own};
    GreatestDepth planes = without_dominated(term.planes);
    for (std::size_t j = term.planes.size() - term.reentrant; j < term.planes.size(); ++j)
      if (is_nowhere_below({own, term.planes[j]}, field)) {
        planes = {own, term.planes[j]};
        break;
      }
    for (std::size_t k = planes.size(); k-- > 0 && planes.size() > 1;) {
      GreatestDepth fewer = planes;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
      if (is_nowhere_below(fewer, field)) planes = std::move(fewer);
    }
    return planes;
  }

  GreatestDepth without_dominated(GreatestDepth planes) const {
    for (std::size_t k = planes.size(); k-- > 0;)
      for (std::size_t i = 0; i < planes.size(); ++i)
        if (i != k && is_deeper(planes[i], planes[k])) {
          planes.erase(planes.begin() + static_cast<std::ptrdiff_t>(k));
          break;
        }
    return planes;
  }

  /// Terms of several planes that a term of one plane undercuts everywhere.
  void drop_dominated(std::vector<GreatestDepth>& terms) const {
    std::vector<HalfSpace> single;
    for (const GreatestDepth& term : terms)
      if (term.size() == 1) single.push_back(term[0]);
    std::erase_if(terms, [&](const GreatestDepth& term) {
      return term.size() > 1 && std::any_of(term.begin(), term.end(), [&](const HalfSpace& plane) {
               return std::any_of(single.begin(), single.end(),
                                  [&](const HalfSpace& other) { return is_deeper(plane, other); });
             });
    });
  }

  /// Terms of several planes that are nowhere below the others.
  void drop_redundant(std::vector<GreatestDepth>& terms) const {
    for (std::size_t t = terms.size(); t-- > 0;) {
      if (terms[t].size() == 1) continue;
      std::vector<const GreatestDepth*> others;
      for (std::size_t u = 0; u < terms.size(); ++u)
        if (u != t) others.push_back(&terms[u]);
      if (is_nowhere_below(terms[t], by_floor(others))) terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(t));
    }
  }

  std::vector<Vec3> corners_;
  ConvexCell cell_;
  Real size_, cap_;
};

/// The terms as one part meets them: its own first, then those of the others in their order.
std::vector<const SurfaceTerm*> ordered_for(std::size_t part, const std::vector<SurfaceTerm>& terms) {
  std::vector<const SurfaceTerm*> ordered;
  for (const bool is_own : {true, false})
    for (const SurfaceTerm& term : terms)
      if ((term.part == part) == is_own) ordered.push_back(&term);
  return ordered;
}

}  // namespace

std::vector<PartDepthField> part_depth_fields(const std::vector<catalog::ConvexPart>& parts, Real size, Real cap) {
  const std::vector<SurfaceTerm> terms = surface_terms(parts, size);
  const bool is_convex = std::all_of(terms.begin(), terms.end(), [&](const SurfaceTerm& term) {
    return std::all_of(parts.begin(), parts.end(), [&](const catalog::ConvexPart& part) {
      return lies_behind(corners_of(part), term.planes[0], size);
    });
  });
  std::vector<PartDepthField> fields;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::vector<const SurfaceTerm*> ordered = ordered_for(p, terms);
    if (!is_convex) {
      fields.push_back(PartWriter(parts[p], size, cap).write(ordered));
      continue;
    }
    PartDepthField& field = fields.emplace_back();
    for (const SurfaceTerm* term : ordered)
      if (std::none_of(field.planes.begin(), field.planes.end(),
                       [&](const HalfSpace& known) { return is_same_plane(known, term->planes[0], size); }))
        field.planes.push_back(term->planes[0]);
  }
  return fields;
}

}  // namespace dem_gpu
