// SPDX-License-Identifier: GPL-3.0-or-later
#include "shape_pipeline/mesh_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "shape_pipeline/mesh_remeshing.h"
#include "shape_pipeline/mesh_topology.h"
#include "shape_pipeline/virtual_scan.h"
#include "tests/support/sample_meshes.h"
#include "tests/support/sample_shapes.h"

namespace shape_pipeline {
namespace {

using namespace test_support;

const RepairOptions kNoWrap{0, Wrapping::never};

double figure(const std::vector<catalog::Check>& checks, const std::string& name) {
  const auto check = std::find_if(checks.begin(), checks.end(), [&](const auto& c) { return c.name == name; });
  return check == checks.end() ? -1 : check->figure;
}

/// Every face with vertices of its own, as STL has them.
catalog::TriangleMesh unwelded(const catalog::TriangleMesh& mesh) {
  catalog::TriangleMesh soup;
  for (const auto& face : mesh.faces) {
    const int first = static_cast<int>(soup.vertices.size());
    for (const int v : face) soup.vertices.push_back(mesh.vertices[v]);
    soup.faces.push_back({first, first + 1, first + 2});
  }
  return soup;
}

catalog::TriangleMesh joined(catalog::TriangleMesh a, const catalog::TriangleMesh& b) {
  const int first = static_cast<int>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& face : b.faces) a.faces.push_back({face[0] + first, face[1] + first, face[2] + first});
  return a;
}

void expect_solid(const RepairedMesh& repaired, double volume, double tolerance) {
  ASSERT_EQ(repaired.refusal, "");
  const MeshTopology topology = mesh_topology(repaired.mesh);
  EXPECT_TRUE(topology.is_closed());
  EXPECT_EQ(topology.components, 1u);
  EXPECT_EQ(topology.euler_number, 2);
  EXPECT_NEAR(signed_volume(repaired.mesh), volume, tolerance * volume);
}

TEST(MeshTopology, CountsOfKnownSolids) {
  const MeshTopology box = mesh_topology(box_mesh({0, 0, 0}, {1, 1, 1}));
  EXPECT_TRUE(box.is_closed());
  EXPECT_EQ(box.euler_number, 2);
  EXPECT_EQ(mesh_topology(torus(3, 1, 12)).euler_number, 0);
  const MeshTopology two = mesh_topology(joined(box_mesh({0, 0, 0}, {1, 1, 1}), box_mesh({2, 0, 0}, {3, 1, 1})));
  EXPECT_EQ(two.components, 2u);
  EXPECT_EQ(two.euler_number, 4);
}

TEST(MeshRepair, WeldsASoup) {
  const catalog::TriangleMesh box = box_mesh({0, 0, 0}, {1, 2, 3});
  const RepairedMesh repaired = repair_mesh(unwelded(box), kNoWrap);
  expect_solid(repaired, 6, 1e-12);
  EXPECT_EQ(figure(repaired.checks, "repair_welded_vertices"), 36 - 8);
}

TEST(MeshRepair, WeldsNearlyEqualVertices) {
  catalog::TriangleMesh soup = unwelded(uv_sphere(1, 12));
  for (std::size_t v = 0; v < soup.vertices.size(); ++v) soup.vertices[v][0] += 1e-7 * (static_cast<double>(v % 3) - 1);
  expect_solid(repair_mesh(soup, kNoWrap), signed_volume(uv_sphere(1, 12)), 1e-5);
}

TEST(MeshRepair, TurnsFlippedFaces) {
  catalog::TriangleMesh mesh = uv_sphere(1, 12);
  const double volume = signed_volume(mesh);
  for (std::size_t f = 0; f < mesh.faces.size(); f += 5) std::swap(mesh.faces[f][1], mesh.faces[f][2]);
  expect_solid(repair_mesh(mesh, kNoWrap), volume, 1e-12);
  // All faces inwards: no edge tells, the sign of the volume does.
  mesh = uv_sphere(1, 12);
  for (auto& face : mesh.faces) std::swap(face[1], face[2]);
  expect_solid(repair_mesh(mesh, kNoWrap), volume, 1e-12);
}

TEST(MeshRepair, FillsAHoleAlongTheSurface) {
  catalog::TriangleMesh mesh = uv_sphere(1, 24);
  const double volume = signed_volume(mesh);
  // Without the cap within 30 degrees of the pole: flat filling would lose 1.3 % of the volume.
  std::erase_if(mesh.faces, [&](const auto& face) {
    return mesh.vertices[face[0]][2] > 0.866 && mesh.vertices[face[1]][2] > 0.866 && mesh.vertices[face[2]][2] > 0.866;
  });
  const RepairedMesh repaired = repair_mesh(mesh, kNoWrap);
  expect_solid(repaired, volume, 0.004);
  EXPECT_EQ(figure(repaired.checks, "repair_filled_holes"), 1);
  // The faces that were there stay where they were, to rounding.
  EXPECT_LT(figure(repaired.checks, "deviation_largest"), 1e-9);
}

TEST(MeshRepair, ClosesACubeThatLacksAFace) {
  catalog::TriangleMesh cube = box_mesh({0, 0, 0}, {0.02, 0.02, 0.02});
  std::erase_if(cube.faces, [&](const auto& face) {
    return std::all_of(face.begin(), face.end(), [&](int v) { return cube.vertices[v][2] > 0.01; });
  });
  ASSERT_EQ(cube.faces.size(), 10u);
  expect_solid(repair_mesh(cube, {}), 8e-6, 0.05);
}

TEST(MeshRepair, SecondVolumeAgreesOnACleanCube) {
  const RepairedMesh repaired = repair_mesh(box_mesh({0, 0, 0}, {1, 1, 1}), {});
  ASSERT_EQ(repaired.refusal, "");
  EXPECT_LT(std::abs(figure(repaired.checks, "volume_second_method")), 0.01);
}

TEST(MeshRepair, KeepsTheLargestOfTwoSurfaces) {
  const RepairedMesh repaired =
      repair_mesh(joined(box_mesh({5, 5, 5}, {5.2, 5.2, 5.2}), box_mesh({0, 0, 0}, {2, 2, 2})), kNoWrap);
  expect_solid(repaired, 8, 1e-12);
  EXPECT_EQ(figure(repaired.checks, "repair_dropped_surfaces"), 1);
}

TEST(MeshRepair, RemovesAFinAndDoubleAndDegenerateFaces) {
  catalog::TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  mesh.vertices.push_back({2, 2, 2});
  mesh.faces.push_back({0, 1, 8});  // a third face on the edge 0-1
  mesh.faces.push_back(mesh.faces[4]);
  mesh.faces.push_back({3, 3, 1});
  const RepairedMesh repaired = repair_mesh(mesh, {0, Wrapping::never});
  EXPECT_EQ(figure(repaired.checks, "repair_duplicate_faces"), 1);
  EXPECT_EQ(figure(repaired.checks, "repair_degenerate_faces"), 1);
  EXPECT_EQ(figure(repaired.checks, "repair_non_manifold_edges"), 1);
  // The fin's area (over 10 % of the box) goes against the kept share: refused by name, or repaired to the box.
  if (repaired.refusal.empty())
    EXPECT_NEAR(signed_volume(repaired.mesh), 1, 1e-9);
  else
    EXPECT_NE(repaired.refusal.find("largest surface has"), std::string::npos) << repaired.refusal;
}

TEST(MeshRepair, ARingNeedsItsGenusStated) {
  const catalog::TriangleMesh ring = torus(3, 1, 24);
  EXPECT_NE(repair_mesh(ring, kNoWrap).refusal.find("Euler number 0, expected 2"), std::string::npos);
  const RepairedMesh repaired = repair_mesh(ring, {1, Wrapping::never});
  ASSERT_EQ(repaired.refusal, "");
  EXPECT_NEAR(signed_volume(repaired.mesh), signed_volume(ring), 1e-9);
}

TEST(MeshRepair, RefusesAnOpenSheetWithTheReason) {
  // Half a sphere: patching it shut would invent more than a fifth of its area.
  catalog::TriangleMesh mesh = uv_sphere(1, 16);
  std::erase_if(mesh.faces, [&](const auto& face) {
    return mesh.vertices[face[0]][2] < -1e-9 || mesh.vertices[face[1]][2] < -1e-9;
  });
  const RepairedMesh repaired = repair_mesh(mesh, kNoWrap);
  EXPECT_TRUE(repaired.mesh.faces.empty());
  EXPECT_NE(repaired.refusal.find("patches make up"), std::string::npos) << repaired.refusal;
}

// Union of two unit balls at distance d: 8 pi / 3 minus the lens pi (4 + d) (2 - d)^2 / 12.
double peanut_volume(double d) { return std::numbers::pi * (8.0 / 3 - (4 + d) * (2 - d) * (2 - d) / 12); }

TEST(MeshRepair, ClosedShellsThatCrossAreOneBody) {
  const RepairedMesh repaired = repair_mesh(joined(uv_sphere(1, 24), moved(uv_sphere(1, 24), 1, {0.9, 0, 0})), {});
  expect_solid(repaired, peanut_volume(0.9), 0.01);  // facets of inscribed balls
  EXPECT_EQ(figure(repaired.checks, "repair_united_bodies"), 1);
  EXPECT_NEAR(figure(repaired.checks, "deviation_largest"), 0, 1e-12);
}

TEST(MeshRepair, NearlyClosedShellsThatCrossAreOneBodyToo) {
  catalog::TriangleMesh open = uv_sphere(1, 24);
  open.faces.pop_back();
  const RepairedMesh repaired = repair_mesh(joined(open, moved(open, 1, {0.9, 0, 0})), {});
  expect_solid(repaired, peanut_volume(0.9), 0.01);
  EXPECT_EQ(figure(repaired.checks, "repair_filled_holes"), 2);
}

TEST(MeshRepair, ASurfaceFromThePointsReplacesTornShellsAndSaysSo) {
  catalog::TriangleMesh torn = uv_sphere(1, 24);
  std::erase_if(torn.faces, [&](const catalog::Triangle& face) { return torn.vertices[face[0]][2] > 0.3; });
  catalog::TriangleMesh lower = torn;  // a second pass of the scanner, turned over: the two overlap in a belt
  for (auto& p : lower.vertices)
    p = {p[0] * std::cos(0.05) + p[1] * std::sin(0.05), p[0] * std::sin(0.05) - p[1] * std::cos(0.05), -p[2]};
  const RepairedMesh repaired = repair_mesh(joined(torn, lower), {});
  expect_solid(repaired, 4 * std::numbers::pi / 3, 0.02);
  EXPECT_EQ(figure(repaired.checks, "repaired_solid"), 0);
}

TEST(Remeshing, KeepsVolumeAndAreaOfARock) {
  const catalog::TriangleMesh rock = virtual_rock({.seed = 7, .notch_depth = 0.3});
  ASSERT_GT(rock.faces.size(), 10000u);
  const RemeshedMesh remeshed = remesh(rock, {6000, RemeshingStyle::edge_collapse});
  EXPECT_LE(remeshed.mesh.faces.size(), 6000u);
  EXPECT_GE(remeshed.mesh.faces.size(), 5900u);
  EXPECT_EQ(mesh_topology(remeshed.mesh).euler_number, 2);
  EXPECT_NEAR(signed_volume(remeshed.mesh), signed_volume(rock), 1e-3 * signed_volume(rock));
  EXPECT_NEAR(surface_area(remeshed.mesh), surface_area(rock), 1e-3 * surface_area(rock));
}

TEST(Remeshing, LeavesASmallMeshAloneAndIsotropicEvensEdges) {
  const catalog::TriangleMesh sphere = uv_sphere(1, 24);
  EXPECT_EQ(remesh(sphere, {10000, RemeshingStyle::edge_collapse}).mesh.faces, sphere.faces);
  const RemeshedMesh even = remesh(sphere, {4000, RemeshingStyle::isotropic});
  EXPECT_NEAR(static_cast<double>(even.mesh.faces.size()), 4000, 1200);
  EXPECT_NEAR(signed_volume(even.mesh), signed_volume(sphere), 3e-3 * signed_volume(sphere));
}

RepairedMesh with_bodies(const catalog::TriangleMesh& mesh, catalog::SeparateBodies bodies, int genus = 0) {
  RepairOptions options = kNoWrap;
  options.genus = genus;
  options.bodies = bodies;
  return repair_mesh(mesh, options);
}

catalog::TriangleMesh inside_out(catalog::TriangleMesh mesh) {
  for (auto& face : mesh.faces) std::swap(face[1], face[2]);
  return mesh;
}

const catalog::TriangleMesh kBox = box_mesh({0, 0, 0}, {2, 2, 2}), kOther = box_mesh({3, 0, 0}, {4, 1, 1});

TEST(SeveralBodies, AreRefusedWithTheWayToJoinThem) {
  const RepairedMesh refused = with_bodies(joined(kBox, kOther), catalog::SeparateBodies::refuse);
  EXPECT_EQ(refused.refusal, "2 separate bodies, the largest surface with 80.0 % of the area, expected one");
  EXPECT_NE(refused.remedy.find("--bodies join"), std::string::npos);
}

TEST(SeveralBodies, TheLargestAloneIsNoDeviation) {
  const RepairedMesh largest = with_bodies(joined(kOther, kBox), catalog::SeparateBodies::largest);
  expect_solid(largest, 8, 1e-12);
  EXPECT_EQ(figure(largest.checks, "repair_dropped_bodies"), 1);
  EXPECT_NEAR(figure(largest.checks, "deviation_largest"), 0, 1e-12);
}

// Unwelded, one inside out: what each needs is done to it alone.
TEST(SeveralBodies, JoinedAreRepairedEach) {
  catalog::TriangleMesh holed = uv_sphere(1, 16);
  holed.faces.pop_back();
  const double whole = signed_volume(uv_sphere(1, 16)), ring = signed_volume(torus(3, 1, 16));
  const catalog::TriangleMesh scan =
      joined(joined(unwelded(inside_out(kBox)), moved(holed, 1, {6, 0, 0})), moved(torus(3, 1, 16), 1, {0, 9, 0}));
  const RepairedMesh repaired = with_bodies(scan, catalog::SeparateBodies::join, 1);
  ASSERT_EQ(repaired.refusal, "");
  const MeshTopology topology = mesh_topology(repaired.mesh);
  EXPECT_TRUE(topology.is_closed());
  EXPECT_EQ(topology.components, 3u);
  EXPECT_EQ(topology.euler_number, 4);
  EXPECT_NEAR(signed_volume(repaired.mesh), 8 + whole + ring, 2e-3 * whole);  // the patch is not the facet
  EXPECT_EQ(figure(repaired.checks, "repair_joined_bodies"), 3);
  EXPECT_EQ(figure(repaired.checks, "repair_turned_surfaces"), 1);
  EXPECT_EQ(figure(repaired.checks, "repair_filled_holes"), 1);
  EXPECT_LT(figure(repaired.checks, "deviation_largest"), 1e-3);
  EXPECT_NE(with_bodies(scan, catalog::SeparateBodies::join, 0).refusal, "");  // the ring has a handle
}

TEST(SeveralBodies, SurfacesInABodyAreCavitiesOrNothing) {
  const catalog::TriangleMesh inner = box_mesh({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
  const catalog::TriangleMesh core = box_mesh({0.75, 0.75, 0.75}, {1.25, 1.25, 1.25});
  const RepairedMesh hollow = with_bodies(joined(inside_out(inner), kBox), catalog::SeparateBodies::join);
  ASSERT_EQ(hollow.refusal, "");
  EXPECT_NEAR(signed_volume(hollow.mesh), 7, 1e-12);
  EXPECT_EQ(figure(hollow.checks, "repair_kept_cavities"), 1);
  const RepairedMesh rattle = with_bodies(joined(joined(core, inside_out(inner)), kBox), catalog::SeparateBodies::join);
  ASSERT_EQ(rattle.refusal, "");
  EXPECT_NEAR(signed_volume(rattle.mesh), 7.125, 1e-12);
  const RepairedMesh doubled = with_bodies(joined(inner, kBox), catalog::SeparateBodies::join);
  expect_solid(doubled, 8, 1e-12);
  EXPECT_EQ(figure(doubled.checks, "repair_united_bodies"), 1);
}

TEST(SeveralBodies, ThatCrossAreUnited) {
  const RepairedMesh crossed = with_bodies(joined(kBox, box_mesh({1, 1, 1}, {3, 3, 3})), catalog::SeparateBodies::join);
  expect_solid(crossed, 15, 1e-12);
  EXPECT_EQ(figure(crossed.checks, "repair_united_bodies"), 1);
  const RepairedMesh touching =
      with_bodies(joined(kBox, box_mesh({2, 0, 0}, {3, 1, 1})), catalog::SeparateBodies::join);
  expect_solid(touching, 9, 1e-12);
}

TEST(SeveralBodies, ThatShareACornerOrAnEdgeStayAsTheyAre) {
  for (const catalog::Point& shift : {catalog::Point{2, 2, 2}, {2, 2, 0.5}, {2, 2, 0}}) {
    const catalog::TriangleMesh other = box_mesh(shift, {shift[0] + 1, shift[1] + 1, shift[2] + 1});
    const RepairedMesh touching = with_bodies(joined(kBox, other), catalog::SeparateBodies::join);
    ASSERT_EQ(touching.refusal, "") << shift[2];
    EXPECT_NEAR(signed_volume(touching.mesh), 9, 1e-12);
    EXPECT_EQ(mesh_topology(touching.mesh).components, 2u);
    EXPECT_EQ(figure(touching.checks, "repair_joined_bodies"), 2);
    const RepairedMesh refused = with_bodies(joined(kBox, other), catalog::SeparateBodies::refuse);
    EXPECT_NE(refused.remedy.find("--bodies join"), std::string::npos);
  }
}

TEST(SeveralBodies, WholeWallsBetweenThemVanish) {
  const catalog::TriangleMesh row =
      joined(joined(kBox, box_mesh({2, 0, 0}, {4, 2, 2})), box_mesh({4, 0, 0}, {6, 2, 2}));
  for (const auto bodies : {catalog::SeparateBodies::refuse, catalog::SeparateBodies::join}) {
    const RepairedMesh whole = with_bodies(unwelded(row), bodies);
    expect_solid(whole, 24, 1e-12);
    EXPECT_EQ(figure(whole.checks, "repair_shared_walls"), 8);
  }
}

// Where a cavity of one is filled by another, there is rock; a core that touches or cuts the wall of its cavity adds to
// it.
TEST(SeveralBodies, CavitiesAreOfTheirOwnBodyAlone) {
  const catalog::TriangleMesh hollow = joined(kBox, inside_out(box_mesh({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5})));
  const auto volume = [&](const catalog::TriangleMesh& other) {
    const RepairedMesh found = with_bodies(joined(other, hollow), catalog::SeparateBodies::join);
    EXPECT_EQ(found.refusal, "");
    return signed_volume(found.mesh);
  };
  EXPECT_NEAR(volume(box_mesh({0.25, 0.25, 0.25}, {1.75, 1.75, 1.75})), 8, 1e-12);
  EXPECT_NEAR(volume(box_mesh({0.25, 0.25, 0.25}, {1.75, 1.75, 1})), 7.5, 1e-12);
  EXPECT_NEAR(volume(box_mesh({0.75, 0.75, 0.5}, {1.25, 1.25, 1})), 7.125, 1e-12);
  EXPECT_NEAR(volume(box_mesh({0.75, 0.75, 0.25}, {1.25, 1.25, 1})), 7.125, 1e-12);
  EXPECT_NEAR(volume(box_mesh({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5})), 8, 1e-12);
  const RepairedMesh all_turned = with_bodies(inside_out(hollow), catalog::SeparateBodies::join);
  EXPECT_NEAR(signed_volume(all_turned.mesh), 7, 1e-12);
  const RepairedMesh alone = with_bodies(joined(hollow, kOther), catalog::SeparateBodies::largest);
  EXPECT_NEAR(signed_volume(alone.mesh), 7, 1e-12);
  const RepairedMesh unasked = with_bodies(hollow, catalog::SeparateBodies::refuse);
  EXPECT_NE(unasked.refusal.find("cavities"), std::string::npos) << unasked.refusal;
  const RepairedMesh pierced =
      with_bodies(joined(kBox, inside_out(box_mesh({1.5, 0.5, 0.5}, {2.5, 1, 1}))), catalog::SeparateBodies::join);
  EXPECT_NEAR(signed_volume(pierced.mesh), 8.125, 1e-12) << "taken for a body that is inside out";
}

TEST(SeveralBodies, ManyOfOneSizeAreNoSpecks) {
  catalog::TriangleMesh many;
  for (int i = 0; i < 1100; ++i) many = joined(many, box_mesh({2.0 * i, 0, 0}, {2.0 * i + 1, 1, 1}));
  EXPECT_NE(with_bodies(many, catalog::SeparateBodies::join).refusal.find("at most 1000"), std::string::npos);
  EXPECT_NE(with_bodies(many, catalog::SeparateBodies::refuse).refusal.find("1100 separate"), std::string::npos);
}

TEST(SeveralBodies, AFlatSheetBesideABodyIsRefused) {
  const catalog::TriangleMesh sheet{{{5, 0, 0}, {7, 0, 0}, {7, 2, 0}, {5, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  RepairOptions options;
  options.bodies = catalog::SeparateBodies::join;
  EXPECT_NE(repair_mesh(joined(kBox, sheet), options).refusal.find("in one plane"), std::string::npos);
  EXPECT_NE(repair_mesh(sheet, {}).refusal.find("in one plane"), std::string::npos);
}

TEST(SeveralBodies, WhatCannotBeJoinedLeavesTheLargestAndSaysSo) {
  const catalog::TriangleMesh sheet{{{3, 0, 0}, {3.5, 0, 0}, {3.5, 1, 0}, {3, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  RepairOptions options;
  options.bodies = catalog::SeparateBodies::join;
  const RepairedMesh repaired = repair_mesh(joined(kBox, sheet), options);
  expect_solid(repaired, 8, 1e-12);
  const auto check = std::find_if(repaired.checks.begin(), repaired.checks.end(),
                                  [](const catalog::Check& c) { return c.name == "repair_joined_bodies"; });
  ASSERT_NE(check, repaired.checks.end());
  EXPECT_FALSE(check->passed);
}

TEST(SeveralBodies, SpecksAreDropped) {
  const RepairedMesh clean =
      with_bodies(joined(kBox, box_mesh({5, 5, 5}, {5.01, 5.01, 5.01})), catalog::SeparateBodies::join);
  expect_solid(clean, 8, 1e-12);
  EXPECT_EQ(figure(clean.checks, "repair_dropped_surfaces"), 1);
}

TEST(SeveralBodies, OneBodyIsRepairedAsEver) {
  const RepairedMesh as_one = with_bodies(kBox, catalog::SeparateBodies::join);
  const RepairedMesh alone = with_bodies(kBox, catalog::SeparateBodies::refuse);
  expect_solid(as_one, 8, 1e-12);
  ASSERT_EQ(as_one.checks.size(), alone.checks.size());
  for (std::size_t c = 0; c < alone.checks.size(); ++c) EXPECT_EQ(as_one.checks[c].name, alone.checks[c].name);
}

}  // namespace
}  // namespace shape_pipeline
