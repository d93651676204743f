// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "decomposition/fit/part_fit.h"
#include "decomposition/solid/exact_piece.h"
#include "decomposition/solid/solid.h"

namespace decomposition {

/// How hard to look for cuts.
struct SearchPlan {
  int directions = 40;            // random directions of cut planes a piece
  int refits = 8;                 // best candidates that are fitted again, longer
  int polishing_rounds = 3;       // rounds of small moves of the best cut
  int vertex_cap = 32;            // an exact piece may have this many vertices ...
  int face_cap = 0;               // ... and faces; 0: any number
  double smallest_volume = 0;     // of a piece [m3]
  double smallest_thickness = 0;  // of a piece [m]
  std::uint64_t seed = 1;
  int threads = 1;
  bool encloses = false;        // stand-ins leave nothing out: hulls instead of fits
  bool compares_hulls = false;  // cuts are compared by hulls even so
};

/// Intersection of half-spaces that bounds a piece: one plane per cut on the way down the tree.
struct Cell {
  std::vector<Plane> planes;  // outward
  std::vector<int> cuts;      // number of the cut each plane belongs to

  Cell half(int cut, const Plane& plane) const {
    Cell result = *this;
    result.planes.push_back(plane);
    result.cuts.push_back(cut);
    return result;
  }
};

/// The solid in one cell with a convex stand-in.
struct Piece {
  Cell cell;
  RegionMoments region;
  PartFit fit;            // of middling length, for comparing cuts
  double error = 0;       // V(fit xor piece) [m3]
  bool is_exact = false;  // the piece is convex and `fit` is its own hull
};

/// Binary space partition of a solid, grown by the cut that lowers the symmetric difference most. The pieces after
/// k cuts are the levels of detail: each is a refinement of the one before.
class CutTree {
 public:
  CutTree(const Solid& solid, const SearchPlan& plan);

  /// Cuts until there are `count` pieces or no cut helps.
  void grow(int count);
  /// Merges halves so that `count` pieces are left and their errors add up to the least there is in this tree: what a
  /// cut gains is known only when those that it makes room for are made as well. Ends the nesting of the levels.
  void merge_down(int count);
  /// Moves the cuts a little, one at a time, as long as that takes volume off the hulls of the pieces.
  void polish_hulls();
  /// Puts the cuts in these places; pieces that are not cut yet are fitted again.
  void move_cuts(const std::vector<Plane>& cuts);
  /// Numbers of the pieces after the first `count` - 1 cuts (fewer if the tree has fewer).
  std::vector<int> pieces(int count) const;
  const Piece& piece(int number) const { return nodes_[static_cast<std::size_t>(number)].piece; }
  const SearchPlan& plan() const { return plan_; }
  const std::vector<Plane>& cuts() const { return cuts_; }
  /// The cell that a cut divides.
  const Cell& divided_cell(int cut) const {
    return nodes_[static_cast<std::size_t>(divided_[static_cast<std::size_t>(cut)])].piece.cell;
  }

 private:
  struct Cut {
    Plane plane;
    std::array<Piece, 2> halves;
    double gain = 0;
  };
  struct Node {
    Piece piece;
    int born = 0;              // number of cuts made when this piece came to be
    int split = -1;            // number of the cut that ended it, -1: still a leaf
    int halves = 0;            // number of the first of its two halves, which stand together
    bool is_merged = false;    // its halves are to become one again
    bool is_outdated = false;  // its cuts have moved since the piece was made, which was cut by then
    bool was_searched = false, was_searched_otherwise = false;
    std::optional<Cut> best;
  };
  /// What stands for the halves when cuts are compared.
  enum class CompareBy { fits, hulls };

  std::optional<Cut> best_cut(const Piece& piece, std::uint64_t seed, CompareBy by) const;
  Node* most_gainful_leaf();
  Node* leaf_without_gain();
  void make_cut(Node& leaf);
  bool has_whole_halves(const Node& node) const;
  std::vector<std::vector<double>> least_errors(int count);
  void mark_merged(int node, int count, const std::vector<std::vector<double>>& least);
  void merge(Node& divided);
  bool is_allowed(const Piece& piece) const;

  Piece make_piece(Cell cell, std::uint64_t seed) const;
  double hull_volume(const std::vector<Plane>& cuts, int cut, std::vector<double>& by_node) const;

  const Solid& solid_;
  SearchPlan plan_;
  std::vector<Node> nodes_;
  std::vector<Plane> cuts_;   // plane seen from its first half
  std::vector<int> divided_;  // node that each cut divides
};

}  // namespace decomposition
