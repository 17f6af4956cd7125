// SPDX-License-Identifier: GPL-3.0-or-later
// Clusters as spec 4 words them, one sample after another in a sorted vector; and what must hold for any list.
#pragma once

#include "film/cluster_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace cardioid::film::test {

/// Its radiance tells it from others of the same luminance.
inline LayerSample sample_of(float y, float tint = 1) { return {{0.5f * y * tint, 0.25f * y, 0.75f * y}, {y, y, y}}; }

class ReferenceList {
public:
    void add(const LayerSample& sample, std::uint32_t taken) {
        const float y = luminance(sample.incident);
        Cluster* home = nullptr;
        float nearest = std::numeric_limits<float>::infinity();
        for (Cluster& c : list_) {
            const float distance = std::max({0.0f, c.min - y, y - c.max});
            if (distance < nearest) nearest = distance, home = &c;
        }
        if (nearest > (taken < 4 ? 0.0f : 0.5f * y)) {
            const Cluster single{.min = y, .max = y};
            const auto at = std::find_if(list_.begin(), list_.end(), [&](const Cluster& c) { return c.min > y; });
            home = &*list_.insert(at, single);
        }
        const float r = luminance(sample.radiance);
        for (int k = 0; k < 3; ++k) home->radiance[k] += sample.radiance[k];
        home->incident += y;
        home->radiance_squared += r * r;
        home->min = std::min(home->min, y);
        home->max = std::max(home->max, y);
        ++home->samples;
        for (std::size_t i = 0; taken >= 4 && i + 1 < list_.size();) {
            if (list_[i + 1].min - list_[i].max <= 0.5f * list_[i + 1].min) {
                unite(i);
            } else {
                ++i;
            }
        }
        if (list_.size() > 8) merge();
    }
    const std::vector<Cluster>& list() const { return list_; }

private:
    static float gradient(const Cluster& c) {
        return c.samples == 1 ? 0.0f : (c.max - c.min) / static_cast<float>(c.samples - 1);
    }
    void merge() {
        std::vector<float> m;
        for (std::size_t i = 0; i + 1 < list_.size(); ++i)
            m.push_back(0.75f * std::abs(gradient(list_[i]) - gradient(list_[i + 1])) +
                        (list_[i + 1].min - list_[i].max));
        unite(static_cast<std::size_t>(std::min_element(m.begin(), m.end()) - m.begin()));
    }
    /// With the one after it.
    void unite(std::size_t best) {
        Cluster& a = list_[best];
        const Cluster& b = list_[best + 1];
        for (int k = 0; k < 3; ++k) a.radiance[k] += b.radiance[k];
        a.incident += b.incident;
        a.radiance_squared += b.radiance_squared;
        a.max = b.max;
        a.samples += b.samples;
        list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(best) + 1);
    }
    std::vector<Cluster> list_;
};

inline void expect_same(std::span<const Cluster> a, std::span<const Cluster> b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(std::memcmp(&a[i], &b[i], sizeof(Cluster)), 0) << i;
}

/// Sorted, disjoint, at most eight; each holds exactly the samples that lie in its range, and their sums.
inline void expect_holds(std::span<const Cluster> list, const std::vector<LayerSample>& samples) {
    ASSERT_LE(list.size(), 8u);
    for (std::size_t i = 0; i + 1 < list.size(); ++i) ASSERT_LT(list[i].max, list[i + 1].min);
    std::size_t total = 0;
    for (const Cluster& c : list) {
        ASSERT_LE(c.min, c.max);
        double radiance[3] = {}, incident = 0, squared = 0;
        float low = std::numeric_limits<float>::infinity(), high = 0;
        std::uint32_t count = 0;
        for (const LayerSample& s : samples) {
            const float y = luminance(s.incident);
            if (y < c.min || y > c.max) continue;
            for (int k = 0; k < 3; ++k) radiance[k] += static_cast<double>(s.radiance[k]);
            incident += static_cast<double>(y);
            squared += std::pow(static_cast<double>(luminance(s.radiance)), 2);
            low = std::min(low, y), high = std::max(high, y);
            ++count;
        }
        ASSERT_EQ(c.samples, count);
        EXPECT_EQ(c.min, low);
        EXPECT_EQ(c.max, high);
        const double rounding = 1e-6 * count;
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(static_cast<double>(c.radiance[k]), radiance[k], rounding * std::abs(radiance[k]));
        EXPECT_NEAR(static_cast<double>(c.incident), incident, rounding * incident);
        EXPECT_NEAR(static_cast<double>(c.radiance_squared), squared, rounding * squared);
        total += count;
    }
    ASSERT_EQ(total, samples.size());
}

/// Streams of light as pixels see them.
enum class Light { constant, few_values, uniform, exponential, wide, lamps, count };

inline std::vector<LayerSample> stream(Light light, int n, unsigned seed) {
    std::mt19937 random(seed * 977u + static_cast<unsigned>(light));
    std::uniform_real_distribution<float> u(1e-3f, 1.0f);
    std::vector<LayerSample> samples;
    for (int i = 0; i < n; ++i) {
        float y = 1;
        switch (light) {
            case Light::constant: y = 0.7f; break;
            case Light::few_values: y = static_cast<float>(1 + random() % 12); break;
            case Light::uniform: y = u(random); break;
            case Light::exponential: y = -std::log(u(random)) + 1e-6f; break;
            case Light::wide: y = std::pow(10.0f, 20 * (u(random) - 0.5f)); break;
            case Light::lamps: y = (random() % 3 == 0 ? 100.0f : 1.0f) * (0.9f + 0.2f * u(random)); break;
            case Light::count: break;
        }
        samples.push_back(sample_of(y, u(random)));
    }
    return samples;
}

}  // namespace cardioid::film::test
