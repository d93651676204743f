// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dem_gpu/contacts/friction/friction_contact.h"

namespace dem_gpu {

struct NoFriction {
  static constexpr bool kEnabled = false;
  static constexpr bool kHasCouple = false;
  using Patch = NoPatch;
};

}  // namespace dem_gpu
