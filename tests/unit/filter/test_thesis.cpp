// SPDX-License-Identifier: GPL-3.0-or-later
// Kernel groups and Poisson weights of the thesis's filter.
#include "filter/filter_kit.h"
#include "filter/thesis.h"

using namespace cardioid;
using namespace cardioid::test;

namespace {

using Band = std::pair<float, float>;

std::vector<Band> grouped(const std::vector<Band>& clusters, float mu = 0.5f) {
    filter::GroupList list(mu);
    for (const auto& [min, max] : clusters) list.add(min, max);
    std::vector<Band> groups;
    for (const filter::Group& g : list.groups()) groups.emplace_back(g.min, g.max);
    return groups;
}

TEST(Groups, ThoseWithinReachAreOne) {
    EXPECT_EQ(grouped({{1, 2}, {5, 6}, {3, 3.5f}}), (std::vector<Band>{{1, 6}})) << "the third joins both";
    EXPECT_EQ(grouped({{1, 2}, {5, 6}}), (std::vector<Band>{{1, 2}, {5, 6}}));
    EXPECT_EQ(grouped({{5, 6}, {1, 2}, {100, 100}}), (std::vector<Band>{{1, 2}, {5, 6}, {100, 100}}));
    EXPECT_EQ(grouped({{2, 2}, {2, 2}}, 0), (std::vector<Band>{{2, 2}}));
    EXPECT_EQ(grouped({{2, 2}, {1, 3}, {2.5f, 2.5f}}, 0), (std::vector<Band>{{1, 3}}));
}

TEST(Groups, DoNotDependOnTheOrder) {
    for (int film = 0; film < 200; ++film) {
        std::vector<Band> clusters;
        for (int i = 0; i < 2 + film % 30; ++i) {
            const float min = std::exp(12 * noise(film, i, 0));
            clusters.emplace_back(min, min * (1 + noise(film, i, 1)));
        }
        const std::vector<Band> groups = grouped(clusters);
        for (int turn = 0; turn < 10; ++turn) {
            for (std::size_t i = clusters.size() - 1; i > 0; --i) {
                const float at = noise(film, static_cast<int>(i), turn, 2) * static_cast<float>(i + 1);
                std::swap(clusters[i], clusters[static_cast<std::size_t>(at)]);
            }
            ASSERT_EQ(grouped(clusters), groups) << "film " << film;
        }
        filter::GroupList list(0.5f);
        for (const auto& [min, max] : clusters) list.add(min, max);
        for (const auto& [min, max] : clusters) {
            const filter::Group& g = list.groups()[list.find(min)];
            ASSERT_TRUE(g.min <= min && max <= g.max);
        }
    }
}

TEST(Poisson, LargestWhereCountsAgree) {
    for (const float k : {1.0f, 2.0f, 7.0f, 1000.0f, 1e6f}) {
        EXPECT_FLOAT_EQ(filter::poisson_weight(k, k), 1);
        EXPECT_LT(filter::poisson_weight(k, 1.5f * k), 1);
        EXPECT_LT(filter::poisson_weight(k, 0.5f * k), 1);
    }
    EXPECT_EQ(filter::poisson_weight(0, 0), 1);
    EXPECT_FLOAT_EQ(filter::poisson_weight(0, 3), std::exp(-3.0f));
    EXPECT_EQ(filter::poisson_weight(3, 0), 0);
    EXPECT_NEAR(filter::poisson_weight(4, 6), std::pow(6.0, 4) * std::exp(-6.0) / (std::pow(4.0, 4) * std::exp(-4.0)),
                1e-5);
}

/// Energy over the raw picture's where a share of the samples finds a lamp.
double energy(float share) {
    const film::Film film = make_film({96, 96, 16}, [=](int x, int y, int i) {
        film::Sample s = wall();
        if (noise(x, y, i, 1) < share) light(s, 0, 0.5f + noise(x, y, i));
        return s;
    });
    return energy_ratio(filtered(film, filter_settings(FilterMethod::thesis)), raw(film));
}

TEST(Thesis, EnergyAsModelled) {
    // Spec 6: its one-sided weights gain where light is sparse. Divided by the samples of clusters alone it would be 1/share.
    EXPECT_NEAR(energy(1), 1, 0.01);
    EXPECT_NEAR(energy(0.5f), 1, 0.02);
    EXPECT_NEAR(energy(0.1f), 1.06, 0.03);
    EXPECT_NEAR(energy(0.01f), 1.3, 0.1);
}

}  // namespace
