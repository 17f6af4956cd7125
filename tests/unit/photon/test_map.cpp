// SPDX-License-Identifier: GPL-3.0-or-later
// Range queries against the literal loop over all photons, compiled at every lane width.
#include "photon/photon_sets.h"
#include "photon/query.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

namespace cardioid::photon {
namespace {

std::vector<std::int32_t> literal(const PhotonMapView& view, const float (&center)[3], float radius) {
    std::vector<std::int32_t> found;
    for (std::int64_t i = 0; i < view.count; ++i) {
        const float* p = view.photons[i].position;
        const float x = p[0] - center[0], y = p[1] - center[1], z = p[2] - center[2];
        if (x * x + y * y + z * z <= radius * radius) found.push_back(static_cast<std::int32_t>(i));
    }
    return found;
}

std::vector<std::int32_t> queried(const PhotonMapView& view, const float (&center)[3], float radius) {
    std::vector<std::int32_t> found;
    for_each_photon(view, center, radius, [&](std::int32_t i) { found.push_back(i); });
    return found;
}

/// n bodies on `threads` threads, dealt out in reverse.
struct Threads {
    int count;
    static void run(void* context, int n, void (*body)(void*, int), void* argument) {
        const int count = static_cast<const Threads*>(context)->count;
        std::vector<std::thread> threads;
        for (int t = 0; t < count; ++t) {
            threads.emplace_back([=] {
                for (int i = n - 1 - t; i >= 0; i -= count) body(argument, i);
            });
        }
        for (std::thread& t : threads) t.join();
    }
};

TEST(PhotonMap, FindsWhatTheLoopOverAllFindsInItsOrder) {
    for (const PhotonSet& set : photon_sets()) {
        PhotonMap map;
        map.build(set.photons, nullptr, nullptr);
        ASSERT_EQ(map.view().count, static_cast<std::int64_t>(set.photons.size())) << set.name;
        std::size_t found = 0;
        for (const Query& q : set.queries) {
            const auto expected = literal(map.view(), q.center, q.radius);
            ASSERT_EQ(queried(map.view(), q.center, q.radius), expected) << set.name << " radius " << q.radius;
            found += expected.size();
        }
        // Queries that find nothing anywhere would prove nothing.
        EXPECT_EQ(found > set.queries.size() / 10, !set.photons.empty()) << set.name;
    }
}

TEST(PhotonMap, FindsPhotonsOnTheSphere) {
    // Along an axis, where the ball touches the box that the cells are chosen by.
    Rng rng(5);
    for (const PhotonSet& set : photon_sets()) {
        PhotonMap map;
        map.build(set.photons, nullptr, nullptr);
        for (int i = 0; i < 2000 && !set.photons.empty(); ++i) {
            const Photon& p = set.photons[rng() % set.photons.size()];
            float center[3] = {p.position[0], p.position[1], p.position[2]};
            float& moved = center[i % 3];
            const float before = moved;
            moved += set.queries[static_cast<std::size_t>(i) % set.queries.size()].radius * (i % 2 == 0 ? 1.0f : -1.0f);
            const float radius = std::abs(before - moved);
            ASSERT_EQ(queried(map.view(), center, radius), literal(map.view(), center, radius)) << set.name;
        }
    }
}

TEST(PhotonMap, KeepsEveryPhotonUnchanged) {
    for (const PhotonSet& set : photon_sets()) {
        PhotonMap map;
        map.build(set.photons, nullptr, nullptr);
        std::vector<bool> seen(set.photons.size());
        for (std::int64_t i = 0; i < map.view().count; ++i) {
            const Photon& p = map.view().photons[i];
            ASSERT_LT(p.source, set.photons.size());
            EXPECT_FALSE(seen[p.source]);
            seen[p.source] = true;
            EXPECT_EQ(std::memcmp(&p, &set.photons[p.source], sizeof p), 0);
        }
    }
}

TEST(PhotonMap, ExtremeRadiiAndCenters) {
    constexpr float k_infinity = std::numeric_limits<float>::infinity();
    for (const PhotonSet& set : photon_sets()) {
        PhotonMap map;
        map.build(set.photons, nullptr, nullptr);
        const PhotonMapView& view = map.view();
        const float here[3] = {0, 0, 0}, far[3] = {3e6f, -2e7f, 1e5f}, nan[3] = {std::nanf(""), 0, 0};
        for (const float radius : {1e9f, 1e30f, k_infinity}) {
            EXPECT_EQ(queried(view, here, radius).size(), set.photons.size()) << set.name;
            EXPECT_EQ(queried(view, far, radius).size(), set.photons.size()) << set.name;
        }
        for (const float radius : {0.0f, 1e-30f, 1.0f, 1e6f}) {
            EXPECT_EQ(queried(view, far, radius), literal(view, far, radius)) << set.name;
        }
        EXPECT_TRUE(queried(view, here, -1.0f).empty());
        EXPECT_TRUE(queried(view, here, std::nanf("")).empty());
        EXPECT_TRUE(queried(view, nan, 1.0f).empty());
    }
}

TEST(PhotonMap, IsTheSameForAnyNumberOfThreads) {
    for (const PhotonSet& set : photon_sets()) {
        PhotonMap serial;
        serial.build(set.photons, nullptr, nullptr);
        for (int count : {1, 2, 7}) {
            Threads threads{count};
            PhotonMap map;
            map.build(set.photons, Threads::run, &threads);
            const auto n = static_cast<std::size_t>(map.view().count);
            ASSERT_EQ(n, set.photons.size());
            if (n > 0) { EXPECT_EQ(std::memcmp(map.view().photons, serial.view().photons, n * sizeof(Photon)), 0); }
            for (const Query& q : set.queries) {
                ASSERT_EQ(queried(map.view(), q.center, q.radius), queried(serial.view(), q.center, q.radius));
            }
        }
    }
}

TEST(PhotonMap, EqualPlacesKeepTheirOrder) {
    std::vector<Photon> photons;
    for (std::size_t i = 0; i < 1000; ++i) photons.push_back(photon_at(static_cast<double>(i % 3), 5, 5, i));
    PhotonMap map;
    map.build(photons, nullptr, nullptr);
    for (std::int64_t i = 1; i < map.view().count; ++i) {
        const Photon &a = map.view().photons[i - 1], &b = map.view().photons[i];
        if (a.position[0] == b.position[0]) { EXPECT_LT(a.source, b.source); }
    }
}

TEST(PhotonMap, IsBuiltAgainForEachPass) {
    PhotonMap map;
    for (int round = 0; round < 2; ++round) {
        for (const PhotonSet& set : photon_sets()) {
            map.build(set.photons, nullptr, nullptr);
            for (std::size_t i = 0; i < set.queries.size(); i += 37) {
                const Query& q = set.queries[i];
                ASSERT_EQ(queried(map.view(), q.center, q.radius), literal(map.view(), q.center, q.radius)) << set.name;
            }
        }
    }
    EXPECT_GT(map.memory_bytes(), 8000 * 60);
}

TEST(PhotonMap, OpensFewCellsWhereThereAreFewPhotons) {
    // A jewel of 1 cm with 20 000 photons in a landscape of 10 km: cells that hold it whole would be tested whole.
    Rng rng(3);
    std::vector<Photon> photons = caustic(20000, 0.01, 0, rng);
    for (const Photon& p : caustic(100, 10000, 0, rng)) photons.push_back(p);
    PhotonMap map;
    map.build(photons, nullptr, nullptr);
    std::uint32_t largest = 0;
    for (std::uint32_t i = 0, n = 1; i < n; ++i) {
        const PhotonCell& cell = map.view().cells[i];
        n += static_cast<std::uint32_t>(__builtin_popcount(cell.octants));
        if (cell.octants == 0) largest = std::max(largest, cell.end - cell.begin);
    }
    EXPECT_LT(largest, 200u);
}

}  // namespace
}  // namespace cardioid::photon
