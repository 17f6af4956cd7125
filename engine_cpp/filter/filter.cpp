// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/filter.h"

#include "filter/cross_bilateral.h"
#include "filter/spread.h"
#include "filter/thesis.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cardioid::filter {

namespace {

using scene::FilterMethod;
using scene::FilterSettings;

constexpr int k_tile = 64;
/// Smaller where every pixel of the kernel has a plane of weights.
constexpr int k_thesis_tile = 16;
/// Standard deviation of the Gaussian over the distance, as a share of the kernel's width.
constexpr float k_spread = 1.0f / 3.0f;
/// Pixels from tap to tap in the default's second pass: light that is still noisy is averaged over a wider surrounding.
constexpr int k_second_step = 3;
/// Standard deviation of the surroundings that share withheld light, in kernel widths.
constexpr float k_withheld_width = 2.0f;

/// Splits raw light into what is shown and what is withheld, so that their sum is the raw light to the last bit.
void split(float raw, float& shown, float& withheld) {
    if (withheld == 0) {
        shown = raw;
        return;
    }
    shown = raw - withheld;
    withheld = raw - shown;
    if (shown + withheld < raw) withheld = std::nextafter(withheld, INFINITY);
    if (shown + withheld > raw) withheld = std::nextafter(withheld, -INFINITY);
}

class Run {
public:
    Run(const film::Film& film, const FilterSettings& settings, int lanes, Filtered& out)
        : film_(film),
          settings_(settings),
          kernel_(settings.filter_method == FilterMethod::cross_bilateral ? select_filter_cross_bilateral(lanes)
                                                                          : select_filter_similar(lanes)),
          geometry_(select_geometry_weights(lanes)),
          out_(out) {}

    bool operator()(const ForEach& for_each) {
        rejection_ = reject(film_, settings_, for_each, &out_.rejection);
        if (settings_.firefly_density > 0 && film_.has_clusters() && rejection_.bits.empty()) return false;
        if (settings_.filter_method == FilterMethod::none || !film_.has_clusters())
            return each_tile(for_each, k_tile, [&](const film::Region& area) { only_reject(area); });
        const bool thesis = settings_.filter_method == FilterMethod::thesis;
        if (!pass(for_each, thesis ? k_thesis_tile : k_tile, 1)) return false;
        if (settings_.filter_method != FilterMethod::clusters) return finish(for_each);
        const float width = k_withheld_width * static_cast<float>(settings_.filter_size);
        if (!spread_withheld(film_, rejection_, picture_, width, for_each, spread_)) return false;
        return pass(for_each, k_tile, k_second_step) && finish(for_each);
    }

private:
    template <class Body>
    bool each_tile(const ForEach& for_each, int size, const Body& body) const {
        const int columns = (out_.width + size - 1) / size, rows = (out_.height + size - 1) / size;
        return for_each(columns * rows, [&](int i) {
            const int x = i % columns * size, y = i / columns * size;
            body({x, y, std::min(size, out_.width - x), std::min(size, out_.height - y)});
        });
    }

    /// From what the pass before has made of the film, if any, to picture_.
    bool pass(const ForEach& for_each, int size, int step) {
        const Picture before = std::exchange(picture_, Picture(out_.width, out_.height));
        const Picture* const filtered = before.width > 0 ? &before : nullptr;
        return each_tile(for_each, size, [&](const film::Region& area) { filter_tile(area, step, filtered); });
    }

    KernelRequest request(const film::Region& area, int step) {
        KernelRequest r;
        r.radius = settings_.filter_size / 2;
        r.step = step;
        r.layers[0] = settings_.filter_direct;
        r.layers[1] = settings_.filter_indirect;
        r.layers[2] = settings_.filter_deep;
        const float spread = k_spread * static_cast<float>(settings_.filter_size);
        r.inverse_two_spread_squared = 0.5f / (spread * spread);
        r.inverse_texture_width_squared = 1 / (settings_.texture_width * settings_.texture_width);
        const std::size_t corner = at(area.x, area.y);
        for (int l = 0; l < film::k_layers; ++l) {
            for (int c = 0; c < 3; ++c) {
                r.result[l][c] = &picture_.layer[l][c][corner];
                r.variance[l][c] = &picture_.variance[l][c][corner];
            }
        }
        for (int c = 0; c < 3; ++c) r.detail[c] = &picture_.detail[c][corner];
        r.stride = out_.width;
        return r;
    }

    void filter_tile(const film::Region& area, int step, const Picture* filtered) {
        KernelRequest r = request(area, step);
        const Tile tile(film_, rejection_, area, r.radius * step + k_patch + 1, filtered);
        r.tile = &tile;
        keep_unfiltered_layers(r);
        std::vector<float> scratch;
        if (settings_.filter_method == FilterMethod::thesis) {
            const auto width = static_cast<std::size_t>(2 * r.radius + 1);
            scratch.resize(width * width * static_cast<std::size_t>(area.width * area.height));
            geometry_(r, scratch.data());
            filter_thesis(r, film_, rejection_, settings_.luminance_sensitivity, scratch.data());
        } else {
            scratch.resize(scratch_floats(tile));
            r.scratch = scratch.data();
            kernel_(r);
        }
    }

    static void keep_unfiltered_layers(const KernelRequest& r) {
        const Tile& t = *r.tile;
        for (int l = 0; l < film::k_layers; ++l) {
            for (int y = 0; y < t.area.height && !r.layers[l]; ++y) {
                for (int c = 0; c < 3; ++c)
                    std::copy_n(t.radiance[l][c] + t.at(0, y), t.area.width, r.result[l][c] + y * r.stride);
            }
        }
    }

    void only_reject(const film::Region& area) {
        for (int y = area.y; y < area.y + area.height; ++y) {
            for (int x = area.x; x < area.x + area.width; ++x) {
                float raw[3], withheld[3];
                film_.raw(x, y, raw);
                withheld_light(film_, rejection_, x, y, withheld);
                for (std::size_t k = 0; k < 3; ++k) {
                    withheld[k] *= film_.exposure();
                    split(raw[k], out_.shown[3 * at(x, y) + k], withheld[k]);
                    out_.withheld[3 * at(x, y) + k] = withheld[k];
                }
            }
        }
    }

    /// Adds the layers up, with what is in none.
    bool finish(const ForEach& for_each) {
        return each_tile(for_each, k_tile, [&](const film::Region& area) {
            for (int y = area.y; y < area.y + area.height; ++y) {
                for (int x = area.x; x < area.x + area.width; ++x) finish_pixel(x, y);
            }
        });
    }

    void finish_pixel(int x, int y) {
        const std::size_t i = at(x, y);
        float rgb[3], withheld[3];
        film_.unfiltered(x, y, rgb);
        withheld_light(film_, rejection_, x, y, withheld);
        for (std::size_t k = 0; k < 3; ++k) {
            for (const auto& layer : picture_.layer) rgb[k] += layer[k][i];
            if (!spread_[k].empty()) rgb[k] += spread_[k][i];
            out_.shown[3 * i + k] = rgb[k] * film_.exposure();
            out_.withheld[3 * i + k] = withheld[k] * film_.exposure();
        }
    }

    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(out_.width) + static_cast<std::size_t>(x);
    }

    const film::Film& film_;
    const FilterSettings& settings_;
    FilterTile kernel_;
    GeometryWeights geometry_;
    Filtered& out_;
    Rejection rejection_;
    Picture picture_;
    std::vector<float> spread_[3];
};

}  // namespace

Filtered run(const film::Film& film, const FilterSettings& settings, const ForEach& for_each, int lanes) {
    Filtered out;
    out.width = film.region().width;
    out.height = film.region().height;
    const std::size_t size = 3 * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height);
    out.shown.assign(size, 0.0f);
    out.withheld.assign(size, 0.0f);
    out.complete = Run(film, settings, lanes, out)(for_each);
    return out;
}

void write(const Filtered& result, const FilterSettings& settings, film::Frame& frame) {
    for (film::Pass& pass : frame.passes) {
        if (pass.name == "Filtered") pass.data = result.shown;
        if (pass.name == "Withheld") pass.data = result.withheld;
        if (pass.name != "Combined" || !settings.use_filter) continue;
        for (std::size_t i = 0; i < result.shown.size() / 3; ++i)
            std::copy_n(&result.shown[3 * i], 3, &pass.data[4 * i]);
    }
}

}  // namespace cardioid::filter
