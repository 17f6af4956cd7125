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

/// A set of classes, one bit each.
using ClassSet = std::uint8_t;
constexpr ClassSet bit(PathClass c) { return static_cast<ClassSet>(1u << static_cast<int>(c)); }
inline constexpr ClassSet k_all_classes = 31;

/// Classes of the light that may be attached at or after a state.
constexpr ClassSet reachable(State s) {
    switch (s) {
        case State::specular: return k_all_classes;
        case State::first_d: return k_all_classes & ~bit(PathClass::d1);
        default: return bit(PathClass::d3) | bit(PathClass::c1) | bit(PathClass::c2);
    }
}

/// String of lobe classes that a photon has seen, from the light.
enum class PhotonState : std::uint8_t {
    start,             ///< L
    specular,          ///< L S+
    diffuse,           ///< L D
    diffuse_specular,  ///< L D S+
    caustic,           ///< L S+ D …        C1 from here on
    indirect_caustic,  ///< L D S+ D …      C2
    indirect,          ///< L D D …         D3
};
inline constexpr int k_photon_states = 7;

constexpr PhotonState step(PhotonState s, bool specular_lobe) {
    switch (s) {
        case PhotonState::start: return specular_lobe ? PhotonState::specular : PhotonState::diffuse;
        case PhotonState::specular: return specular_lobe ? s : PhotonState::caustic;
        case PhotonState::diffuse: return specular_lobe ? PhotonState::diffuse_specular : PhotonState::indirect;
        case PhotonState::diffuse_specular: return specular_lobe ? s : PhotonState::indirect_caustic;
        default: return s;
    }
}

/// Class of the light that a photon brings to a surface with D lobes, where a camera path gathers it.
constexpr PathClass stored_class(PhotonState before) {
    switch (step(before, false)) {
        case PhotonState::diffuse: return PathClass::d2;
        case PhotonState::caustic: return PathClass::c1;
        case PhotonState::indirect_caustic: return PathClass::c2;
        default: return PathClass::d3;
    }
}

/// Classes that a photon in this state may still be stored as.
constexpr ClassSet reachable(PhotonState s) {
    switch (s) {
        case PhotonState::start: return k_all_classes & ~bit(PathClass::d1);
        case PhotonState::specular:
        case PhotonState::caustic: return bit(PathClass::c1);
        case PhotonState::diffuse: return bit(PathClass::d3) | bit(PathClass::c2);
        case PhotonState::diffuse_specular:
        case PhotonState::indirect_caustic: return bit(PathClass::c2);
        default: return bit(PathClass::d3);
    }
}

}  // namespace cardioid::path
