// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "workflows/bench/bench_plan.h"

namespace workflows {

// Cases of the bench digitize. Each measures one way of digitising against a truth.

/// A scan's cloud against the mesh that its authors made of it.
struct CloudPair {
  std::string name, cloud, mesh;  // file names
};
inline const std::vector<CloudPair> kCloudPairs{{"stone10", "epfl_stone10_cloud.ply", "epfl_stone10.stl"},
                                                {"stone14", "epfl_stone14_cloud.ply", "epfl_stone14.stl"}};
CaseResult measure_cloud(const std::filesystem::path& scans, const CloudPair& pair);

/// Grains of a virtual tomogram against the meshes that it was made of.
struct StackCase {
  std::string name;
  double diameter;  // of each grain [voxels]
  int grains;
  double one_to_one = 0;    // share asked for; 0: no goal
  double volume_error = 0;  // mean magnitude asked for; 0: no goal
};
inline const std::vector<StackCase> kStackCases{{"rocks-10", 10, 40},
                                                {"rocks-20", 20, 40},
                                                {"rocks-40", 40, 16},
                                                {"rocks-60", 60, 12, 0.95, 0.01},
                                                {"rocks-80", 80, 8}};
inline const std::vector<StackCase> kScanStackCases{
    {"scans-20", 20, 40}, {"scans-40", 40, 20}, {"scans-60", 60, 20, 0.95, 0.01}};
/// Of the meshes in turn.
CaseResult measure_stack(const StackCase& stack, const std::vector<catalog::TriangleMesh>& meshes);
/// Of random rocks, every fourth with a notch, and a ball.
CaseResult measure_rock_stack(const StackCase& stack);

/// Parts of rocks, each of 65 % of all directions, against the motions that parted them.
struct RegistrationCase {
  std::string name;
  int parts;
  double noise;  // standard deviation over the rock's size [-]
};
inline const std::vector<RegistrationCase> kRegistrationCases{{"two", 2, 1e-3}, {"three", 3, 1e-3}, {"noisy", 3, 4e-3}};
CaseResult measure_registration(const RegistrationCase& wanted);

/// Parts of two rocks, which must not be joined.
CaseResult measure_strangers();

/// Four rocks on a plate: plane, grains, volumes.
CaseResult measure_plate();

/// Two captures of one stone, torn as they come: repaired, aligned, what differs.
inline const std::vector<std::string> kCaptureFiles{"epfl_capture_scanner.stl", "epfl_capture_iphone_lidar.stl"};
CaseResult measure_captures(const std::filesystem::path& scans);

/// The visual hull of a grain on a virtual turntable against the best that its views could give.
struct TurntableCase {
  std::string name;
  int views;
  int side = 384;        // of the images [pixels]
  double noise = 3;      // standard deviation, of a contrast of 180 [grey values]
  double elevation = 0;  // of a perspective camera [rad]; 0: an orthographic one
};
inline const std::vector<TurntableCase> kTurntableCases{{"turntable-12", 12},
                                                        {"turntable-36", 36},
                                                        {"turntable-72", 72},
                                                        {"turntable-36-coarse", 36, 128, 15},
                                                        {"turntable-36-raised", 36, 384, 3, 0.35}};
/// Of each of these solids.
CaseResult measure_turntable(const TurntableCase& turntable,
                             const std::vector<std::pair<std::string, catalog::TriangleMesh>>& solids);
/// A random rock, one with a notch, a flat one: with their names.
std::vector<std::pair<std::string, catalog::TriangleMesh>> turntable_rocks();

/// New grains made to match those of a measured sand against its descriptors.
inline constexpr char kPopulationFile[] = "sandatlas_hamburg_grain_descriptors.csv";
CaseResult measure_population(const std::filesystem::path& scans);

/// Descriptors of bodies with closed forms: largest relative error.
CaseResult measure_exact_descriptors();

/// Descriptors of one rock as two scanners see it at four resolutions: spread.
CaseResult measure_scanner_spread();

}  // namespace workflows
