// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "catalog/convex_part.h"
#include "dem_gpu/overlap_probe.h"

/// Random pairs of convex bodies of size about 1, by kinds of difficulty.
namespace exact {

struct Pair {
  catalog::ConvexPart part_a, part_b;
  dem_gpu::PosePair poses;
};

using Random = std::mt19937;

struct PairClass {
  std::string name;
  int share;  // of 100 pairs
  std::function<Pair(Random&)> make;
};

const std::vector<PairClass>& pair_classes();

}  // namespace exact
