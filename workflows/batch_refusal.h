// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <new>
#include <stdexcept>
#include <string>

#include "catalog/input_error.h"

namespace workflows {

/// Why `work` refuses one item of a batch; empty if it does not. `subject`: the item, for reasons that do not name it.
inline std::string refusal_of(const std::string& subject, const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const catalog::InputError& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return subject + ": needs more memory than there is; crop it, halve its resolution or take a larger machine";
  } catch (const std::logic_error& error) {
    // CGAL reports a geometry it cannot handle this way: this item is lost, the batch is not.
    return subject + ": the geometry library gave up (" + error.what() + "); clean the scan";
  }
}

}  // namespace workflows
