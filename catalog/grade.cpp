// SPDX-License-Identifier: Apache-2.0
#include "catalog/grade.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace catalog {
namespace {

constexpr int kSound = 1, kReserved = 2, kDoubtful = 3;

/// These inform where they do not pass.
constexpr std::string_view kInforming[] = {
    "given_normals",           "face_normals",          "repaired_solid",
    "poisson_solid",           "filled_area_share",     "remeshed_faces",
    "remeshing_volume_change", "remeshing_area_change", "remeshing_self_intersections",
    "turntable_views"};

/// The statistics of a population say nothing against a single solid of it.
constexpr std::string_view kPopulation = "population_";

/// These tell, passed or not, of another way or of what the source does not show.
constexpr std::string_view kReservations[] = {"repair_alpha_wrap", "reconstruction_alpha_wrap", "visual_hull",
                                              "assumed_third_axis"};

constexpr std::string_view kReplaced = "repaired_solid";  // does not pass where the repaired mesh was replaced

/// Before that, these are of the mesh that was replaced.
constexpr std::string_view kOfReplacedMesh[] = {"self_intersections", "kept_area_share"};

template <std::size_t N>
bool is_one_of(const std::string_view (&names)[N], const std::string& name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

int grade_of(const Check& check) {
  if (is_one_of(kReservations, check.name)) return kReserved;
  if (check.passed) return kSound;
  return is_one_of(kInforming, check.name) || check.name.starts_with(kPopulation) ? kReserved : kDoubtful;
}

}  // namespace

int grade_of(const std::vector<Check>& checks) {
  if (checks.empty()) return kDoubtful;
  const auto replaced = std::find_if(checks.begin(), checks.end(),
                                     [](const Check& check) { return check.name == kReplaced && !check.passed; });
  int grade = kSound;
  for (auto check = checks.begin(); check != checks.end(); ++check) {
    const bool is_of_replaced = replaced != checks.end() && check < replaced && is_one_of(kOfReplacedMesh, check->name);
    grade = std::max(grade, is_of_replaced ? std::min(grade_of(*check), kReserved) : grade_of(*check));
  }
  return grade;
}

std::string grade_meaning(int grade) {
  if (grade == kSound) return "every check passed";
  if (grade == kReserved) return "usable with a reservation: no decisive check failed";
  return "a decisive check did not pass";
}

}  // namespace catalog
