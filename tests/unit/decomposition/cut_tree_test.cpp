// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/search/cut_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "decomposition/search/cut_candidates.h"
#include "tests/property/decomposition/random_bodies.h"
#include "tests/support/solids.h"

namespace decomposition {
namespace {

constexpr int kPieces = 9, kMore = 7;
constexpr double kCells = 1e5;

CutTree tree_of(const Solid& solid, int pieces, std::uint64_t seed) {
  SearchPlan plan;
  plan.directions = 6;
  plan.refits = 2;
  plan.polishing_rounds = 0;
  plan.seed = seed;
  CutTree tree(solid, plan);
  tree.grow(pieces);
  return tree;
}

/// Cuts moved off their places, so that the first ones are no longer the most useful.
void spoil(CutTree& tree, const Solid& solid) {
  std::vector<Plane> cuts = tree.cuts();
  for (std::size_t c = 0; c < cuts.size(); ++c) cuts[c].offset += 0.05 * solid.diagonal() * (c % 2 ? 1 : -1);
  tree.move_cuts(cuts);
}

double error_of(const CutTree& tree) {
  double error = 0;
  for (const int piece : tree.pieces(kPieces)) error += tree.piece(piece).error;
  return error;
}

/// Every cell is bounded by the tree's own cuts, and the cells fill the solid.
void expect_partition(const CutTree& tree, const Solid& solid) {
  const std::vector<int> pieces = tree.pieces(kPieces);
  ASSERT_EQ(pieces.size(), static_cast<std::size_t>(kPieces));
  ASSERT_EQ(tree.cuts().size(), static_cast<std::size_t>(kPieces - 1));
  double volume = 0;
  for (const int number : pieces) {
    const Cell& cell = tree.piece(number).cell;
    ASSERT_EQ(cell.planes.size(), cell.cuts.size());
    for (std::size_t k = 0; k < cell.cuts.size(); ++k) {
      const Plane& cut = tree.cuts().at(static_cast<std::size_t>(cell.cuts[k]));
      const double sign = dot(cell.planes[k].normal, cut.normal) > 0 ? 1 : -1;
      EXPECT_EQ(cell.planes[k].offset, sign * cut.offset);
      EXPECT_EQ(norm(cell.planes[k].normal - sign * cut.normal), 0);
    }
    volume += solid.volume_inside(cell.planes);
  }
  EXPECT_NEAR(volume, solid.volume_inside({}), 1e-9 * volume);
}

TEST(CutTree, MergesTheLeastUsefulCutsAndKeepsThePartition) {
  int improved = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Solid solid(random_bodies::random_rock(seed), kCells);
    CutTree smaller = tree_of(solid, kPieces, seed), tree = tree_of(solid, kPieces + kMore, seed);
    spoil(smaller, solid);
    spoil(tree, solid);
    tree.merge_down(kPieces);
    expect_partition(tree, solid);
    for (const int number : tree.pieces(kPieces)) {
      const Piece& piece = tree.piece(number);
      EXPECT_NEAR(piece.region.volume, solid.volume_inside(piece.cell.planes), 1e-9 * solid.volume());
    }
    // Merging the last cuts would give the smaller tree, but for chance in the fits of its pieces.
    EXPECT_LE(error_of(tree), 1.02 * error_of(smaller));
    improved += error_of(tree) < 0.98 * error_of(smaller);
    tree.grow(kPieces + 1);  // and goes on
    EXPECT_EQ(tree.pieces(kPieces + 1).size(), static_cast<std::size_t>(kPieces + 1));
  }
  EXPECT_GE(improved, 1) << "nothing but the last cuts was merged: the test shows nothing";
}

TEST(CutCandidates, HoldThePlaneOfSymmetryOfABodyThatHasOne) {
  // Two balls in a row: the plane between them is the one that pays.
  const Solid solid(solids::together({solids::moved(solids::sphere(1, 3), {-1.2, 0, 0}),
                                      solids::moved(solids::sphere(1, 3), {1.2, 0, 0})}),
                    kCells);
  Random random(1);
  const std::vector<Vec3> points = solid.points_inside({}, 2000, random);
  Piece whole;
  whole.region = moments_of_points(points, solid.volume_inside({}));
  SearchPlan plan;
  plan.directions = 0;
  const CutTrial trial{solid, plan, whole, points};
  const std::vector<Plane> planes = candidate_planes(trial, random);
  // Moments of 2000 points: a degree or two, a few hundredths.
  EXPECT_TRUE(std::any_of(planes.begin(), planes.end(), [](const Plane& plane) {
    return std::abs(plane.normal.x) > std::cos(0.05) && std::abs(plane.offset) < 0.05;
  }));
}

TEST(CutCandidates, GoThroughTheNeckOfABodyAndAlongIt) {
  // A long body with a neck at x = 0.8, far from the planes through its middle.
  constexpr double kNeck = 0.8;
  catalog::TriangleMesh mesh = solids::scaled(solids::sphere(1, 4), {2, 1, 1});
  for (catalog::Point& p : mesh.vertices) {
    const double width = 1 - 0.6 * std::exp(-std::pow((p[0] - kNeck) / 0.25, 2));
    p[1] *= width;
    p[2] *= width;
  }
  const Solid solid(mesh, kCells);
  SearchPlan plan;
  plan.directions = 0;
  Random random(1);
  const std::vector<Vec3> points = solid.points_inside({}, 2000, random);
  const CutTree tree(solid, plan);
  const CutTrial trial{solid, plan, tree.piece(0), points};
  const std::vector<Plane> planes = candidate_planes(trial, random);
  // The ground of the neck is flat: its deepest vertex is a face's length off, planes are 30 degrees apart.
  EXPECT_TRUE(std::any_of(planes.begin(), planes.end(), [](const Plane& plane) {
    return std::abs(plane.normal.x) > std::cos(0.27) && std::abs(plane.offset / plane.normal.x - kNeck) < 0.15;
  }));
}

}  // namespace
}  // namespace decomposition
