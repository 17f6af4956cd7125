// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter/filter.h"

#include "filter/cross_bilateral.h"
#include "filter/thesis.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace cardioid::filter {

namespace {

using scene::FilterMethod;
using scene::FilterSettings;

constexpr int k_tile = 64;
/// Smaller where every pixel of the kernel has a plane of weights.
constexpr int k_thesis_tile = 16;
/// Standard deviation of the Gaussian over the distance, as a share of the kernel's width.
constexpr float k_spread = 1.0f / 3.0f;

/// Raw light of clusters that are withheld, without exposure.
void withheld_light(const film::Film& film, const Rejection& rejection, int x, int y, float (&rgb)[3]) {
    std::fill_n(rgb, 3, 0.0f);
    for (int l = 0; l < film::k_layers; ++l) {
        const unsigned bits = rejection.withheld(x, y, l);
        if (bits == 0) continue;
        const auto clusters = film.clusters().view(x, y, l);
        for (std::size_t i = 0; i < clusters.size(); ++i) {
            for (int k = 0; k < 3 && (bits >> i & 1) != 0; ++k) rgb[k] += clusters[i].radiance[k];
        }
    }
    const auto taken = static_cast<float>(film.samples(x, y));
    for (float& c : rgb) c = taken > 0 ? c / taken : 0;
}

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
        const int size = settings_.filter_method == FilterMethod::thesis ? k_thesis_tile : k_tile;
        std::vector<film::Region> tiles;
        for (int y = 0; y < out_.height; y += size) {
            for (int x = 0; x < out_.width; x += size)
                tiles.push_back({x, y, std::min(size, out_.width - x), std::min(size, out_.height - y)});
        }
        return for_each(static_cast<int>(tiles.size()),
                        [&](int i) { filter_tile(tiles[static_cast<std::size_t>(i)]); });
    }

private:
    void filter_tile(const film::Region& area) {
        if (settings_.filter_method == FilterMethod::none || !film_.has_clusters()) return only_reject(area);
        KernelRequest r;
        r.radius = settings_.filter_size / 2;
        r.layers[0] = settings_.filter_direct;
        r.layers[1] = settings_.filter_indirect;
        r.layers[2] = settings_.filter_deep;
        const float spread = k_spread * static_cast<float>(settings_.filter_size);
        r.inverse_two_spread_squared = 0.5f / (spread * spread);
        r.inverse_texture_width_squared = 1 / (settings_.texture_width * settings_.texture_width);
        const Tile tile(film_, rejection_, area, r.radius + k_patch + 1);
        r.tile = &tile;
        const auto pixels = static_cast<std::size_t>(area.width) * static_cast<std::size_t>(area.height);
        std::vector<float> light(pixels * film::k_layers * 3), scratch;
        for (std::size_t i = 0; i < film::k_layers * 3; ++i) r.result[i / 3][i % 3] = &light[i * pixels];
        if (settings_.filter_method == FilterMethod::thesis) {
            const auto width = static_cast<std::size_t>(2 * r.radius + 1);
            scratch.resize(width * width * pixels);
            geometry_(r, scratch.data());
            filter_thesis(r, film_, rejection_, settings_.luminance_sensitivity, scratch.data());
        } else {
            scratch.resize(scratch_floats(tile));
            r.scratch = scratch.data();
            kernel_(r);
        }
        write(r);
    }

    void only_reject(const film::Region& area) {
        for (int y = area.y; y < area.y + area.height; ++y) {
            for (int x = area.x; x < area.x + area.width; ++x) {
                float raw[3], withheld[3];
                film_.raw(x, y, raw);
                withheld_light(film_, rejection_, x, y, withheld);
                for (int k = 0; k < 3; ++k) {
                    withheld[k] *= film_.exposure();
                    split(raw[k], out_.shown[index(x, y) + k], withheld[k]);
                    out_.withheld[index(x, y) + k] = withheld[k];
                }
            }
        }
    }

    void write(const KernelRequest& r) {
        const film::Region& area = r.tile->area;
        for (int y = 0; y < area.height; ++y) {
            for (int x = 0; x < area.width; ++x) {
                const int px = area.x + x, py = area.y + y;
                float rgb[3], withheld[3];
                film_.unfiltered(px, py, rgb);
                withheld_light(film_, rejection_, px, py, withheld);
                for (int k = 0; k < 3; ++k) {
                    for (int l = 0; l < film::k_layers; ++l)
                        rgb[k] +=
                            r.layers[l] ? r.result[l][k][y * area.width + x] : r.tile->radiance[l][k][r.tile->at(x, y)];
                    out_.shown[index(px, py) + k] = rgb[k] * film_.exposure();
                    out_.withheld[index(px, py) + k] = withheld[k] * film_.exposure();
                }
            }
        }
    }

    std::size_t index(int x, int y) const {
        return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(out_.width) + static_cast<std::size_t>(x));
    }

    const film::Film& film_;
    const FilterSettings& settings_;
    FilterTile kernel_;
    GeometryWeights geometry_;
    Filtered& out_;
    Rejection rejection_;
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
