// SPDX-License-Identifier: GPL-3.0-or-later
// Which class of path a vertex belongs to (spec 1): a five-state automaton over the S/D classes of the sampled lobes, read from
// the camera. Thesis Fig. 5.4 keeps a bit string instead.
#pragma once

#include <cstdint>

namespace cardioid::path {

/// String of lobe classes seen so far, from the camera.
enum class State : std::uint8_t {
    specular,     ///< S*           light attached here is D1
    first_d,      ///< S* D         D2
    more_d,       ///< … D D        D3
    caustic_hit,  ///< … D S+       C1
    caustic_d,    ///< … D S+ D     C2
};
inline constexpr int k_states = 5;

/// Class of the light attached after a state; also the index of its buffer.
enum class PathClass : std::uint8_t { d1, d2, d3, c1, c2 };
inline constexpr int k_classes = 5;

constexpr State step(State s, bool specular_lobe) {
    if (specular_lobe) return s == State::specular ? State::specular : State::caustic_hit;
    switch (s) {
        case State::specular: return State::first_d;
        case State::caustic_hit: return State::caustic_d;
        default: return State::more_d;
    }
}

constexpr PathClass class_of(State s) { return static_cast<PathClass>(s); }

/// True for the classes that photons estimate in the hybrid mode.
constexpr bool is_caustic(PathClass c) { return c == PathClass::c1 || c == PathClass::c2; }

}  // namespace cardioid::path
