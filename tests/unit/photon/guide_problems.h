// SPDX-License-Identifier: GPL-3.0-or-later
// Emission problems whose answer is known: which (emitter, u) matters and how much.
#pragma once

#include "photon/guide.h"
#include "statistics/ttest.h"

#include <algorithm>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace cardioid::photon {

using Rng = std::mt19937;

inline float unit_float(Rng& rng) { return static_cast<float>(rng() >> 8) * 0x1p-24f; }

struct Cube {
    float u[k_cube];
};
inline Cube random_cube(Rng& rng) { return {{unit_float(rng), unit_float(rng), unit_float(rng), unit_float(rng)}}; }

/// What a photon brings to the picture: flux per unit of emission density.
using Integrand = std::function<float(std::int32_t emitter, const float (&u)[k_cube], Rng& rng)>;

struct Problem {
    std::string name;
    int emitters;
    Integrand integrand;
};

/// 0.5 to 1.5: what a photon brings depends on its further path too.
inline float noisy(Rng& rng) { return 0.5f + unit_float(rng); }

inline float in_box(const float (&u)[k_cube], const float (&lower)[k_cube], const float (&upper)[k_cube], Rng& rng) {
    for (int k = 0; k < k_cube; ++k) {
        if (u[k] < lower[k] || u[k] >= upper[k]) return 0;
    }
    return noisy(rng);
}

inline Problem twelve_lamps() {
    return {"12 lamps, 10 % of the directions of one matter", 12,
            [](std::int32_t e, const float(&u)[k_cube], Rng& rng) {
                return e == 5 ? in_box(u, {0, 0, 0.3f, 0.4f}, {1, 1, 0.62f, 0.72f}, rng) : 0.0f;
            }};
}
inline Problem sun() {
    return {"sun with 1 % of the area", 1, [](std::int32_t, const float(&u)[k_cube], Rng& rng) {
                const float x = u[0] - 0.37f, y = u[1] - 0.61f;
                return x * x + y * y < 0.0564f * 0.0564f ? noisy(rng) : 0.0f;
            }};
}
inline Problem box() {
    return {"4-D box", 1, [](std::int32_t, const float(&u)[k_cube], Rng& rng) {
                return in_box(u, {0.1f, 0.45f, 0.62f, 0.33f}, {0.4f, 0.75f, 0.92f, 0.63f}, rng);
            }};
}
inline Problem everything() {
    return {"everything matters", 4, [](std::int32_t, const float(&)[k_cube], Rng& rng) { return noisy(rng); }};
}
inline Problem little_of_everything() {
    return {"10 % of everything, by chance", 500,
            [](std::int32_t, const float(&)[k_cube], Rng& rng) { return unit_float(rng) < 0.1f ? noisy(rng) : 0.0f; }};
}

struct Outcome {
    double gathered = 0;  ///< share of the photons that brought something
    statistics::Moments picture;
};

/// Emits `count` photons by the guide; those that bring something become lessons.
inline Outcome emit(const PhotonGuide& guide, const Problem& problem, int count, Rng& rng,
                    std::vector<Lesson>* lessons = nullptr) {
    Outcome outcome;
    for (int i = 0; i < count; ++i) {
        const float choice =
            std::min((static_cast<float>(i) + unit_float(rng)) / static_cast<float>(count), 0.9999999f);
        const Emission e = guide.draw(choice, random_cube(rng).u);
        const float value = problem.integrand(e.emitter, e.u, rng);
        outcome.picture.add(static_cast<double>(value / e.density));
        if (!(value > 0)) continue;
        outcome.gathered += 1.0 / count;
        if (lessons) lessons->push_back({e.emitter, {e.u[0], e.u[1], e.u[2], e.u[3]}, value, e.density});
    }
    return outcome;
}

/// Two training passes.
inline PhotonGuide trained(const Problem& problem, int photons, Rng& rng, std::vector<Lesson>* kept = nullptr) {
    PhotonGuide guide(std::vector<float>(static_cast<std::size_t>(problem.emitters), 1.0f));
    std::vector<Lesson> lessons;
    for (int pass = 0; pass < 2; ++pass) {
        emit(guide, problem, photons, rng, &lessons);
        guide.learn(lessons);
    }
    if (kept) *kept = lessons;
    return guide;
}

}  // namespace cardioid::photon
