// SPDX-License-Identifier: GPL-3.0-or-later
// Names the kinds of file that are mistaken for a film.
#pragma once

#include <string>
#include <string_view>

namespace cardioid::film {

/// ": it is a …" for a file that starts with `start` (16 bytes are enough); empty where it is not known.
std::string what_it_is(std::string_view start);

}  // namespace cardioid::film
