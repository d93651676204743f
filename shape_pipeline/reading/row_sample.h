// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "shape_pipeline/point_cloud.h"
#include "shape_pipeline/surfaces/random_stream.h"

namespace shape_pipeline {

/// Which of a file's rows are kept where they are more than `limit`: one of each block of consecutive ones, drawn by a
/// fixed seed, so that neither the scanner's lines nor the file's order shows.
class RowSample {
 public:
  RowSample(std::size_t rows, std::size_t limit) : block_(rows > limit ? (rows + limit - 1) / limit : 1) {}

  /// For rows asked for in order, from 0.
  bool keeps(std::size_t row) {
    if (row % block_ == 0) chosen_ = block_ == 1 ? 0 : random_.bits() % block_;
    return row % block_ == chosen_;
  }

 private:
  std::size_t block_, chosen_ = 0;
  RandomStream random_{1};
};

struct SampledCloud {
  PointCloud cloud;       // in the file's unit
  std::size_t total = 0;  // points of the file
};

}  // namespace shape_pipeline
