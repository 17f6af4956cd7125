// SPDX-License-Identifier: GPL-3.0-or-later
// Sets of photons for tests, and the queries that belong to them.
#pragma once

#include "photon/photon.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace cardioid::photon {

struct Query {
    float center[3];
    float radius;
};

struct PhotonSet {
    std::string name;
    std::vector<Photon> photons;
    std::vector<Query> queries;
};

inline Photon photon_at(double x, double y, double z, std::size_t number) {
    Photon p{};
    p.position[0] = static_cast<float>(x);
    p.position[1] = static_cast<float>(y);
    p.position[2] = static_cast<float>(z);
    p.flux[0] = 1;
    p.source = static_cast<std::uint32_t>(number);
    return p;
}

using Rng = std::mt19937;

inline double unit(Rng& rng) { return std::uniform_real_distribution<double>(0, 1)(rng); }

/// Around photons and anywhere, near and far, with radii from 0 over every order of magnitude to all of the set.
inline std::vector<Query> queries_for(const std::vector<Photon>& photons, double size, Rng& rng, int count = 1500) {
    std::vector<Query> queries;
    for (int i = 0; i < count; ++i) {
        Query q{};
        const double spread = std::pow(10.0, -7 * unit(rng)) * size * (i % 3);
        for (int k = 0; k < 3; ++k) {
            const double origin =
                photons.empty() ? 0.0 : static_cast<double>(photons[rng() % photons.size()].position[k]);
            q.center[k] = static_cast<float>(origin + spread * (unit(rng) - 0.5) * 3);
        }
        // A center at a photon itself finds it with radius 0.
        if (i % 5 == 0 && !photons.empty()) {
            const Photon& p = photons[rng() % photons.size()];
            for (int k = 0; k < 3; ++k) q.center[k] = p.position[k];
        }
        q.radius = i % 7 == 0 ? 0.0f : static_cast<float>(size * 2 * std::pow(10.0, -7 * unit(rng)));
        queries.push_back(q);
    }
    return queries;
}

/// Points on a caustic's cusp, 20 % of them anywhere on the floor and a wall: the shape of real maps.
inline std::vector<Photon> caustic(std::size_t count, double size, double x, Rng& rng) {
    std::vector<Photon> photons;
    for (std::size_t i = 0; i < count; ++i) {
        const double t = 6.283185307179586 * unit(rng), a = unit(rng) - 0.5, b = unit(rng) - 0.5;
        const double blur = 0.001 * unit(rng) * a;
        if (unit(rng) < 0.1)
            photons.push_back(photon_at(x + size * a, size * b, 0, i));
        else if (unit(rng) < 0.1)
            photons.push_back(photon_at(x + 0.5 * size, size * a, size * b, i));
        else
            photons.push_back(photon_at(x + 0.05 * size * (3 * std::cos(t) - std::cos(3 * t) + blur),
                                        0.05 * size * (3 * std::sin(t) - std::sin(3 * t) + blur), 0, i));
    }
    return photons;
}

inline std::vector<PhotonSet> photon_sets() {
    Rng rng(7);
    std::vector<PhotonSet> sets;
    const auto add = [&](const char* name, std::vector<Photon> photons, double size) {
        auto queries = queries_for(photons, size, rng);
        sets.push_back({name, std::move(photons), std::move(queries)});
    };
    add("none", {}, 1);
    add("one", {photon_at(1, 2, 3, 0)}, 1);
    std::vector<Photon> two{photon_at(1, 2, 3, 0), photon_at(1, 2, 3.5, 1)};
    add("two", two, 1);
    std::vector<Photon> volume, equal, line, twice, mixed;
    for (std::size_t i = 0; i < 5000; ++i) {
        volume.push_back(photon_at(unit(rng), unit(rng), unit(rng), i));
        equal.push_back(photon_at(3, -1, 0.25, i));
        line.push_back(photon_at(2, 0.001 * static_cast<double>(rng() % 2000), -5, i));
    }
    add("uniform in a cube", volume, 1);
    add("all in one point", equal, 1);
    add("line with many duplicates", line, 2);
    for (std::size_t i = 0; i < 3000; ++i) twice.push_back(photon_at(static_cast<double>(i % 2), 0, 0, i));
    add("two points", twice, 1);
    add("caustic of 10 m", caustic(8000, 10, 0, rng), 10);
    add("caustic of 1 mm", caustic(8000, 0.001, 0, rng), 0.001);
    add("caustic of 10 km", caustic(8000, 10000, 0, rng), 10000);
    add("caustic of 1 m, 10 km away", caustic(8000, 1, 10000, rng), 1);
    // A jewel at the origin of a landscape: cells must go down to what float can tell apart there.
    mixed = caustic(6000, 0.001, 0, rng);
    for (Photon p : caustic(2000, 10000, 300, rng)) {
        p.source = static_cast<std::uint32_t>(mixed.size());
        mixed.push_back(p);
    }
    sets.push_back({"1 mm within 10 km", mixed, queries_for({mixed.begin(), mixed.begin() + 6000}, 0.001, rng)});
    return sets;
}

}  // namespace cardioid::photon
