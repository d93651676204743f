// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/validation/hard_cases/hard_case.h"

namespace hard_cases {

struct Tower {
  int cubes;
  double edge;  // [m]
  double gap;   // between cubes at the start [m]
  double time;  // [s]
};

/// Does a tower of cubes stand, and how fast does its fastest cube still move?
Finding tower(const Tower& tower);

}  // namespace hard_cases
