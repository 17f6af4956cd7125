// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/film.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cardioid::film {

namespace {
constexpr const char* k_class_names[k_classes] = {"D1", "D2", "D3", "C1", "C2"};

enum PassIndex : int { pass_combined, pass_depth, pass_normal, pass_classes, pass_raw = pass_classes + k_classes };

void accumulate(float (&sum)[3], const float (&value)[3]) {
    for (int k = 0; k < 3; ++k) sum[k] += value[k];
}

float total(const float (&c)[3]) { return c[0] + c[1] + c[2]; }

/// Sums of 2^24 samples below this are finite.
constexpr float k_largest = 1e30f;

/// Small exactly where every value of the sample is, or where large ones cancel out.
float checksum(const Sample& s) {
    float sum = s.alpha + s.depth + total(s.normal) + total(s.unfiltered) + total(s.detail) + total(s.mirrored_detail) +
                total(s.feature_normal) + s.feature_depth + s.feature_depth_squared;
    for (const auto& c : s.radiance) sum += total(c);
    for (const LayerSample& l : s.layers) sum += total(l.radiance) + total(l.incident);
    return sum;
}
}  // namespace

Region crop_region(const scene::Settings& s) {
    const auto& c = s.crop;
    if (c[2] <= 0 || c[3] <= 0) return {0, 0, s.width, s.height};
    const int x0 = std::clamp(c[0], 0, s.width - 1), y0 = std::clamp(c[1], 0, s.height - 1);
    return {x0, y0, std::min(c[2], s.width - x0), std::min(c[3], s.height - y0)};
}

Film::Film(const scene::Settings& settings)
    : region_(crop_region(settings)),
      exposure_(settings.exposure),
      transparent_(settings.transparent_film),
      filter_(settings.filter),
      pixels_(static_cast<std::size_t>(region_.width) * static_cast<std::size_t>(region_.height)) {
    if (settings.record_clusters || settings.filter.use_filter) clusters_ = ClusterStore(region_.width, region_.height);
}

bool FilmWriter::add(int x, int y, const Sample& sample, bool first) {
    if (!(std::abs(checksum(sample)) <= k_largest)) return false;
    x -= film_->region_.x;
    y -= film_->region_.y;
    const std::size_t i = static_cast<std::size_t>(y) * film_->region_.width + static_cast<std::size_t>(x);
    Film::Pixel& p = film_->pixels_[i];
    for (int c = 0; c < k_classes; ++c) accumulate(p.radiance[c], sample.radiance[c]);
    accumulate(p.unfiltered, sample.unfiltered);
    p.alpha += sample.alpha;
    if (first) p.depth = sample.depth;
    accumulate(p.normal, sample.normal);
    if (film_->has_clusters()) {
        accumulate(p.detail, sample.detail);
        accumulate(p.feature_normal, sample.feature_normal);
        p.feature_depth += sample.feature_depth;
        p.feature_depth_squared += sample.feature_depth_squared;
        accumulate(p.mirrored_detail, sample.mirrored_detail);
        const float mirrored = std::min(luminance(sample.mirrored_detail), k_largest_squared);
        p.mirrored_detail_squared += mirrored * mirrored;
        editor_.open(film_->clusters_, x, y);
        for (int l = 0; l < k_layers; ++l) {
            const bool kept = editor_.add(x, y, l, sample.layers[l], p.samples);
            // Light of negative lamps has no place among clusters: it stays as it is.
            if (!kept) accumulate(p.unfiltered, sample.layers[l].radiance);
        }
    }
    ++p.samples;
    return true;
}

void FilmWriter::close() { editor_.close(); }

PixelFeatures Film::features(int x, int y) const {
    const Pixel& p = pixel(x, y);
    PixelFeatures f;
    if (p.samples == 0) return f;
    const float inv = 1.0f / static_cast<float>(p.samples);
    for (int k = 0; k < 3; ++k) f.detail[k] = p.detail[k] * inv;
    const float weight = luminance(p.detail);
    if (weight <= 0) return f;
    for (int k = 0; k < 3; ++k) f.normal[k] = p.feature_normal[k] / weight;
    f.depth = p.feature_depth / weight;
    f.depth_variance = std::max(0.0f, p.feature_depth_squared / weight - f.depth * f.depth);
    for (int k = 0; k < 3; ++k) f.mirrored_detail[k] = p.mirrored_detail[k] * inv;
    const float mirrored = luminance(f.mirrored_detail);
    if (p.samples > 1)
        f.detail_variance =
            std::max(0.0f, p.mirrored_detail_squared * inv - mirrored * mirrored) / static_cast<float>(p.samples - 1);
    return f;
}

void Film::unfiltered(int x, int y, float (&rgb)[3]) const {
    const Pixel& p = pixel(x, y);
    const float inv = p.samples > 0 ? 1.0f / static_cast<float>(p.samples) : 0.0f;
    for (int k = 0; k < 3; ++k) rgb[k] = p.unfiltered[k] * inv;
    if (photons_.empty()) return;
    const std::size_t i = static_cast<std::size_t>(y) * region_.width + static_cast<std::size_t>(x);
    for (const auto& c : photons_[i].classes) accumulate(rgb, c);
}

void Film::set_photons(int x, int y, const float (&classes)[k_classes - 1][3]) {
    if (photons_.empty()) photons_.resize(pixels_.size());
    auto& to = photons_[static_cast<std::size_t>(y) * region_.width + static_cast<std::size_t>(x)].classes;
    for (int c = 0; c < k_classes - 1; ++c) std::copy_n(classes[c], 3, to[c]);
}

Frame Film::make_frame() const {
    Frame f;
    f.width = region_.width;
    f.height = region_.height;
    const std::size_t n = pixels_.size();
    f.passes.push_back({"Combined", 4, std::vector<float>(4 * n, 0.0f)});
    f.passes.push_back({"Depth", 1, std::vector<float>(n, 1e10f)});
    f.passes.push_back({"Normal", 3, std::vector<float>(3 * n, 0.0f)});
    for (const char* name : k_class_names) f.passes.push_back({name, 3, std::vector<float>(3 * n, 0.0f)});
    if (has_clusters()) {
        for (const char* name : {"Raw", "Filtered", "Withheld"})
            f.passes.push_back({name, 3, std::vector<float>(3 * n, 0.0f)});
    }
    return f;
}

float Film::class_mean(std::size_t i, int path_class, int channel) const {
    float mean = pixels_[i].radiance[path_class][channel] / static_cast<float>(pixels_[i].samples);
    if (!photons_.empty() && path_class > 0) mean += photons_[i].classes[path_class - 1][channel];
    return mean * exposure_;
}

void Film::raw(int x, int y, float (&rgb)[3]) const {
    const std::size_t i = static_cast<std::size_t>(y) * region_.width + static_cast<std::size_t>(x);
    for (int k = 0; k < 3; ++k) {
        rgb[k] = 0;
        if (pixels_[i].samples == 0) continue;
        for (int c = 0; c < k_classes; ++c) rgb[k] += class_mean(i, c, k);
    }
}

void Film::resolve(const Region& part, Frame& frame, bool keep_combined) const {
    for (int y = part.y; y < part.y + part.height; ++y) {
        for (int x = part.x; x < part.x + part.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y - region_.y) * region_.width + (x - region_.x);
            const Pixel& p = pixels_[i];
            if (p.samples == 0) continue;
            frame.samples = std::max(frame.samples, static_cast<int>(p.samples));
            const float inv = 1.0f / static_cast<float>(p.samples);
            float* combined = &frame.passes[pass_combined].data[4 * i];
            for (int k = 0; k < 3; ++k) {
                float sum = 0;
                for (int c = 0; c < k_classes; ++c) {
                    const float mean = class_mean(i, c, k);
                    frame.passes[pass_classes + c].data[3 * i + k] = mean;
                    sum += mean;
                }
                if (!keep_combined) combined[k] = sum;
                if (has_clusters()) frame.passes[pass_raw].data[3 * i + k] = sum;
                frame.passes[pass_normal].data[3 * i + k] = p.normal[k] * inv;
            }
            combined[3] = transparent_ ? std::clamp(p.alpha * inv, 0.0f, 1.0f) : 1.0f;
            frame.passes[pass_depth].data[i] = p.depth;
        }
    }
}

std::int64_t Film::memory_bytes() const {
    return static_cast<std::int64_t>(pixels_.size() * sizeof(Pixel) + photons_.size() * sizeof(PhotonMeans)) +
           clusters_.memory_bytes();
}

}  // namespace cardioid::film
