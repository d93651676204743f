// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "catalog/triangle_mesh.h"
#include "shape_pipeline/point_cloud.h"

namespace shape_pipeline {

/// A crushed rock: the intersection of random half-spaces with rounded edges, stretched, bumped, perhaps notched.
struct RockRecipe {
  std::uint64_t seed = 1;
  double size = 0.03;        // intermediate axis, about [m]
  double flatness = 0.8;     // short / intermediate axis before cutting [-]
  double elongation = 0.8;   // intermediate / long axis before cutting [-]
  int facets = 14;           // half-spaces
  double angularity = 24;    // exponent of the blend of half-spaces: 8 is pebble-like, 60 nearly sharp
  double roughness = 0.015;  // height of the bumps / size [-]
  double notch_depth = 0;    // of the hollow in one side / distance to the centre [-]; above 0 it is not convex
  int subdivisions = 5;      // of the icosahedron: 20 * 4^n faces
};

/// Closed, outward mesh of genus 0, star-shaped about its centre: the truth that a virtual scan is compared with.
catalog::TriangleMesh virtual_rock(const RockRecipe& recipe);

/// How a scanner sees a surface.
struct ScannerFlaws {
  std::uint64_t seed = 1;
  int points = 6000;          // before the gap is cut
  double noise_sigma = 3e-5;  // standard deviation of each coordinate [m]
  double gap_angle = 0.35;    // half angle, seen from the centre, of the cap that the scanner missed [rad]; 0: none
  int stray_points = 6;       // far from the surface
};

/// Points on the mesh, evenly by area, with noise, a missing cap and stray points; no normals.
PointCloud virtual_scan(const catalog::TriangleMesh& mesh, const ScannerFlaws& flaws);

struct VirtualScanSet {
  int count = 4;
  std::uint64_t seed = 1;
  ScannerFlaws flaws;  // seed is taken from the set
};

/// Writes rock_01.ply, rock_02.ply, ... (metres) and truth.json into the folder, which is made if it is missing.
/// Every second rock has a notch; aspect ratios, angularity and roughness vary. Returns the cloud files.
std::vector<std::filesystem::path> write_virtual_scans(const std::filesystem::path& folder, const VirtualScanSet& set);

/// What is known of a scan's solid.
struct ScanTruth {
  double volume = 0;        // [m3]
  double surface_area = 0;  // [m2]
  double noise_sigma = 0;   // [m]
};

/// Truth by file name from {"scans": [{"file": "rock_01.ply", "volume": 1e-5, "surface_area": 3e-3}]}, SI units. Throws
/// InputError for a bad file.
std::map<std::string, ScanTruth> read_truth(const std::filesystem::path& path);

}  // namespace shape_pipeline
