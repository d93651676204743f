// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/built_in_solids.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <utility>

#include "catalog/input_error.h"
#include "catalog/nearest_word.h"
#include "shape_pipeline/solids/grid_surface.h"
#include "shape_pipeline/solids/polyhedra.h"
#include "shape_pipeline/solids/round_solids.h"

namespace shape_pipeline {
namespace {

using Values = std::map<std::string, double>;

struct Maker {
  SolidKind kind;
  std::function<BuiltSolid(const Values&, std::uint64_t seed)> make;
};

/// Boxes of width 1 that run `arm` widths from a middle one: to either side or only to the positive one, on each axis.
struct Arms {
  std::array<bool, 3> is_positive, is_negative;
};

BuiltSolid armed_solid(const Arms& arms, double arm) {
  std::array<std::vector<double>, 3> planes;
  std::array<int, 3> middle;
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    if (arms.is_negative[i]) planes[i].push_back(-0.5 - arm);
    middle[i] = arms.is_negative[i] ? 1 : 0;
    planes[i].insert(planes[i].end(), {-0.5, 0.5});
    if (arms.is_positive[i]) planes[i].push_back(0.5 + arm);
    count += arms.is_negative[i] + arms.is_positive[i];
  }
  const auto is_full = [&](int i, int j, int k) { return (i != middle[0]) + (j != middle[1]) + (k != middle[2]) <= 1; };
  return {grid_surface(planes, is_full), 0, 1 + count * arm, 1e-12};
}

const std::vector<Maker>& makers() {
  const SolidParameter detail{"detail", 16, 4, 128, "faces along a quarter turn"};
  const SolidParameter arm{"arm", 1, 0.1, 20, "length of an arm beyond the middle, over its width"};
  const auto whole = [](const Values& values, const char* name) {
    return static_cast<int>(std::lround(values.at(name)));
  };
  const auto plain = [](BuiltSolid (*solid)()) { return [solid](const Values&, std::uint64_t) { return solid(); }; };
  const auto armed = [](const Arms& arms) {
    return [arms](const Values& values, std::uint64_t) { return armed_solid(arms, values.at("arm")); };
  };
  static const std::vector<Maker> list{
      {{"tetrahedron", "4 triangles", {}}, plain(tetrahedron_solid)},
      {{"cube", "6 squares", {}}, plain(cube_solid)},
      {{"octahedron", "8 triangles", {}}, plain(octahedron_solid)},
      {{"dodecahedron", "12 pentagons", {}}, plain(dodecahedron_solid)},
      {{"icosahedron", "20 triangles", {}}, plain(icosahedron_solid)},
      {{"truncated-tetrahedron", "4 hexagons, 4 triangles", {}}, plain(truncated_tetrahedron_solid)},
      {{"bilunabirotunda", "Johnson solid J91: 8 triangles, 2 squares, 4 pentagons", {}}, plain(bilunabirotunda_solid)},
      {{"hexagonal-prism",
        "elongated prism over a regular hexagon",
        {{"length", 4, 0.05, 50, "of the prism, over the hexagon's edge"}}},
       [](const Values& values, std::uint64_t) { return hexagonal_prism_solid(values.at("length")); }},
      {{"dice",
        "cube with rounded edges and corners",
        {{"rounding", 0.3, 0.01, 1, "radius over half the edge; 1 is a sphere"}, detail}},
       [whole](const Values& values, std::uint64_t) {
         return dice_solid(values.at("rounding"), whole(values, "detail"));
       }},
      {{"L", "two square bars at a right angle", {arm}}, armed({{true, true, false}, {false, false, false}})},
      {{"cross", "four square arms in a plane", {arm}}, armed({{true, true, false}, {true, true, false}})},
      {{"hexapod", "six square arms along the axes", {arm}}, armed({{true, true, true}, {true, true, true}})},
      {{"ring", "torus", {{"tube", 0.35, 0.02, 0.95, "radius of the tube over that of its centre line"}, detail}},
       [whole](const Values& values, std::uint64_t) { return ring_solid(values.at("tube"), whole(values, "detail")); }},
      {{"superquadric",
        "(|x/a|^(2/e2) + |y/b|^(2/e2))^(e2/e1) + |z/c|^(2/e1) = 1",
        {{"e1", 0.5, 0.1, 2, "exponent towards the poles: 1 round, 0.1 nearly square, 2 a double cone"},
         {"e2", 0.5, 0.1, 2, "exponent around the equator"},
         {"a", 1, 0.01, 100, "semi-axis along x, in any unit"},
         {"b", 1, 0.01, 100, "semi-axis along y"},
         {"c", 1, 0.01, 100, "semi-axis along z"},
         detail}},
       [whole](const Values& values, std::uint64_t) {
         const Superquadric form{values.at("e1"), values.at("e2"), {values.at("a"), values.at("b"), values.at("c")}};
         return superquadric_solid(form, whole(values, "detail"));
       }},
      {{"crushed-rock",
        "intersection of random half-spaces, another one for each seed",
        {{"facets", 16, 8, 400, "half-spaces"},
         {"spread", 0.35, 0, 0.6, "of their distances from the centre, over the largest"}}},
       [whole](const Values& values, std::uint64_t seed) {
         return crushed_rock_solid(whole(values, "facets"), values.at("spread"), seed);
       }},
  };
  return list;
}

const Maker& maker_of(const std::string& name) {
  std::vector<std::string> names;
  for (const Maker& maker : makers()) {
    if (maker.kind.name == name) return maker;
    names.push_back(maker.kind.name);
  }
  const auto nearest = catalog::nearest_word(name, names);
  throw catalog::InputError("unknown solid '" + name + "'" + (nearest ? ", did you mean '" + *nearest + "'?" : "") +
                            "; known are " + catalog::quoted_list(names));
}

std::string range_text(const SolidParameter& parameter) {
  char text[80];
  std::snprintf(text, sizeof text, "%g to %g", parameter.least, parameter.most);
  return text;
}

void check_parameter(const SolidKind& kind, const std::string& name, double value) {
  std::vector<std::string> names;
  for (const SolidParameter& known : kind.parameters) {
    names.push_back(known.name);
    if (known.name != name) continue;
    if (value >= known.least && value <= known.most) return;
    char found[40];
    std::snprintf(found, sizeof found, "%g", value);
    throw catalog::InputError(kind.name + ": " + name + " (" + known.meaning + "): expected " + range_text(known) +
                              ", found " + found);
  }
  throw catalog::InputError(kind.name + ": unknown parameter '" + name + "'; " +
                            (names.empty() ? "this solid has none" : catalog::word_hint(name, names)));
}

}  // namespace

const std::vector<SolidKind>& built_in_solids() {
  static const std::vector<SolidKind> kinds = [] {
    std::vector<SolidKind> list;
    for (const Maker& maker : makers()) list.push_back(maker.kind);
    return list;
  }();
  return kinds;
}

SolidRecipe complete_recipe(const SolidRecipe& recipe) {
  const SolidKind& kind = maker_of(recipe.solid).kind;
  for (const auto& [name, value] : recipe.parameters) check_parameter(kind, name, value);
  SolidRecipe complete = recipe;
  for (const SolidParameter& parameter : kind.parameters)
    complete.parameters.try_emplace(parameter.name, parameter.usual);
  return complete;
}

BuiltSolid built_in_solid(const SolidRecipe& recipe) {
  const SolidRecipe complete = complete_recipe(recipe);
  return maker_of(complete.solid).make(complete.parameters, complete.seed);
}

}  // namespace shape_pipeline
