// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#pragma once

#include <stdexcept>
#include <string>

namespace credo::apps {

/// What `work` returns. Where it complains of values that do not fit together (std::logic_error: the libraries know no
/// file then), the complaint begins with `subject`, the file or folder that the values are from.
template <typename Work>
auto about(const std::string& subject, const Work& work) {
  try {
    return work();
  } catch (const std::logic_error& error) {
    throw std::runtime_error(subject + ": " + error.what());
  }
}

}  // namespace credo::apps
