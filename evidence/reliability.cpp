// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "evidence/reliability.hpp"

#include <sstream>
#include <stdexcept>

namespace credo::evidence {

void refuse_reliability(double reliability) {
  std::ostringstream message;
  message << "a reliability must be in [0, 1]; got " << reliability;
  throw std::invalid_argument(message.str());
}

}  // namespace credo::evidence
