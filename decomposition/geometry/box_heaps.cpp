// SPDX-License-Identifier: GPL-3.0-or-later
#include "decomposition/geometry/box_heaps.h"

#include <algorithm>
#include <numeric>

namespace decomposition {

std::vector<Heap> heaps_of(const std::vector<Box>& boxes) {
  std::vector<std::size_t> heap_of(boxes.size());
  std::iota(heap_of.begin(), heap_of.end(), std::size_t{0});
  for (std::size_t a = 0; a < boxes.size(); ++a)
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      const auto [low, high] = std::minmax({heap_of[a], heap_of[b]});
      if (low != high && boxes[a].meets(boxes[b])) std::replace(heap_of.begin(), heap_of.end(), high, low);
    }
  std::vector<Heap> result(boxes.size());
  for (std::size_t k = 0; k < boxes.size(); ++k) result[heap_of[k]].push_back(k);
  std::erase_if(result, [](const Heap& heap) { return heap.empty(); });
  return result;
}

}  // namespace decomposition
