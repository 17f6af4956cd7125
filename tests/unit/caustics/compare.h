// SPDX-License-Identifier: GPL-3.0-or-later
// Two integrators, one picture: renders with different seeds are replicates, means of the whole picture and of
// 16 blocks are compared by Welch's test, and must be shown to be close (two one-sided tests): what is too noisy to
// tell fails.
#pragma once

#include "analytic/replicates.h"
#include "caustics/caustic_scenes.h"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace cardioid::test {

inline constexpr int k_blocks_across = 4;
inline constexpr int k_blocks = k_blocks_across * k_blocks_across;
inline constexpr int k_replicates = 12;
/// False alarms of one comparison; the seeds are fixed.
inline constexpr double k_alarm = 1e-3;

/// Luminance: unequal weights, so that channels that change places show.
struct Means {
    double whole = 0;
    std::array<double, k_blocks> block{};
};

inline Means means_of(const film::Frame& f, const std::string& pass) {
    const film::Pass& p = *f.find(pass);
    Means m;
    std::array<double, k_blocks> pixels{};
    for (int y = 0; y < f.height; ++y) {
        for (int x = 0; x < f.width; ++x) {
            const float* v = &p.data[static_cast<std::size_t>((y * f.width + x) * p.channels)];
            const double value = 0.2126 * static_cast<double>(v[0]) + 0.7152 * static_cast<double>(v[1]) +
                                 0.0722 * static_cast<double>(v[2]);
            const auto b = static_cast<std::size_t>(y * k_blocks_across / f.height * k_blocks_across +
                                                    x * k_blocks_across / f.width);
            m.block[b] += value;
            pixels[b] += 1;
            m.whole += value / (static_cast<double>(f.width) * f.height);
        }
    }
    for (std::size_t b = 0; b < m.block.size(); ++b) m.block[b] /= pixels[b];
    return m;
}

inline const std::vector<std::string>& compared_passes() {
    static const std::vector<std::string> all{"Combined", "D1", "D2", "D3", "C1", "C2"};
    return all;
}

/// Pictures of one integrator: [replicate][pass of compared_passes()].
using Pictures = std::vector<std::vector<Means>>;

inline std::vector<Means> picture(const scene::SceneDesc& scene, std::uint32_t seed) {
    const auto frame = render_frame(scene, seed);
    std::vector<Means> all;
    for (const std::string& pass : compared_passes()) all.push_back(means_of(*frame, pass));
    return all;
}

inline Pictures pictures(const scene::SceneDesc& scene, std::uint32_t first_seed, int replicates = k_replicates) {
    Pictures p;
    for (int s = 0; s < replicates; ++s) p.push_back(picture(scene, first_seed + static_cast<std::uint32_t>(s)));
    return p;
}

/// 2·fine − coarse, seed by seed: without the part of the bias that halves from one radius to the other.
inline Pictures extrapolated(const Pictures& coarse, const Pictures& fine) {
    Pictures p = fine;
    for (std::size_t s = 0; s < p.size(); ++s) {
        for (std::size_t k = 0; k < p[s].size(); ++k) {
            const auto without_bias = [](double a, double b) { return 2 * b - a; };
            p[s][k].whole = without_bias(coarse[s][k].whole, fine[s][k].whole);
            for (std::size_t b = 0; b < p[s][k].block.size(); ++b)
                p[s][k].block[b] = without_bias(coarse[s][k].block[b], fine[s][k].block[b]);
        }
    }
    return p;
}

inline scene::SceneDesc path_traced(const CausticCase& c) {
    scene::SceneDesc scene = c.scene;
    scene.settings.record_clusters = false;
    scene.settings.integrator = scene::IntegratorKind::path_tracing;
    scene.settings.samples = c.path_samples;
    return scene;
}

inline scene::SceneDesc with_photons(const CausticCase& c, scene::IntegratorKind kind) {
    scene::SceneDesc scene = c.scene;
    scene.settings.record_clusters = false;
    scene.settings.integrator = kind;
    scene.settings.samples = c.photon_samples;
    // Photons that bring direct light too must be more for the same noise.
    scene.settings.photons = kind == scene::IntegratorKind::photon_mapping ? 3 * c.photons : c.photons;
    scene.settings.photon_radius = c.radius;
    scene.settings.radius_shrink = 1;
    return scene;
}

/// Photons at two radii with the same seeds, extrapolated to radius 0.
inline Pictures photon_pictures(const CausticCase& c, const scene::SceneDesc& scene, std::uint32_t first_seed,
                                int replicates = k_replicates) {
    scene::SceneDesc finer = scene;
    finer.settings.photon_radius *= c.finer;
    return extrapolated(pictures(scene, first_seed, replicates), pictures(finer, first_seed, replicates));
}

template <class Value>
statistics::Moments moments_of(const Pictures& p, Value value) {
    statistics::Moments m;
    for (const auto& seed : p) m.add(value(seed));
    return m;
}

struct Agreement {
    bool agree = true;
    std::string report;
    double ratio = 1;       ///< of the whole pictures
    double half_width = 0;  ///< of the 98 % interval of their difference, relative
};

/// Whether `tested` and `judge` are one picture in pass `k` of compared_passes(). `scale`: what bounds are relative to,
/// 0: the judge's mean.
inline Agreement compare_pass(const Pictures& judge, const Pictures& tested, std::size_t k, double bound,
                              double block_bound, double scale = 0) {
    const auto whole = [&](const Pictures& p) {
        return moments_of(p, [&](const std::vector<Means>& m) { return m[k].whole; });
    };
    const statistics::Moments a = whole(judge), b = whole(tested);
    if (scale == 0) scale = a.mean;
    const statistics::TResult t = statistics::welch_test(b, a);
    Agreement r;
    r.ratio = b.mean == a.mean ? 1 : b.mean / a.mean;
    r.half_width = t.half_width(0.02) / scale;
    r.agree = !t.rejected(k_alarm) && t.equivalent(bound * scale, 0.02);
    char line[200];
    std::snprintf(line, sizeof line, "%s: %.5g for %.5g, ratio %.4f +- %.4f%s", compared_passes()[k].c_str(), b.mean,
                  a.mean, r.ratio, r.half_width, r.agree ? "" : " DIFFERS");
    r.report = line;
    const double level = statistics::sidak(k_alarm, k_blocks), width = statistics::sidak(0.02, k_blocks);
    for (std::size_t i = 0; i < k_blocks && block_bound > 0; ++i) {
        const auto block = [&](const Pictures& p) {
            return moments_of(p, [&](const std::vector<Means>& m) { return m[k].block[i]; });
        };
        const statistics::Moments ba = block(judge), bb = block(tested);
        const statistics::TResult bt = statistics::welch_test(bb, ba);
        if (!bt.rejected(level) && bt.equivalent(block_bound * std::max(scale, ba.mean), width)) continue;
        r.agree = false;
        std::snprintf(line, sizeof line, "\n    block %d: %.5g for %.5g +- %.3g%s", static_cast<int>(i), bb.mean,
                      ba.mean, bt.half_width(width), bt.rejected(level) ? " differs" : " cannot be told");
        r.report += line;
    }
    return r;
}

}  // namespace cardioid::test
