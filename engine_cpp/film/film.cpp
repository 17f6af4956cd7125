// SPDX-License-Identifier: GPL-3.0-or-later
#include "film/film.h"

#include <algorithm>
#include <cmath>

namespace cardioid::film {

namespace {
constexpr const char* k_class_names[k_classes] = {"D1", "D2", "D3", "C1", "C2"};

enum PassIndex : int { pass_combined, pass_depth, pass_normal, pass_classes };
}  // namespace

Region crop_region(const scene::Settings& s) {
    const auto& c = s.crop;
    if (c[2] <= 0 || c[3] <= 0) return {0, 0, s.width, s.height};
    const int x0 = std::clamp(c[0], 0, s.width - 1), y0 = std::clamp(c[1], 0, s.height - 1);
    return {x0, y0, std::min(c[2], s.width - x0), std::min(c[3], s.height - y0)};
}

void add_to_class(Frame& frame, std::size_t pixel, int path_class, const float (&rgb)[3], float scale) {
    for (std::size_t k = 0; k < 3; ++k) {
        frame.passes[static_cast<std::size_t>(pass_classes + path_class)].data[3 * pixel + k] += rgb[k] * scale;
        frame.passes[pass_combined].data[4 * pixel + k] += rgb[k] * scale;
    }
}

Film::Film(const scene::Settings& settings)
    : region_(crop_region(settings)),
      exposure_(settings.exposure),
      transparent_(settings.transparent_film),
      pixels_(static_cast<std::size_t>(region_.width) * static_cast<std::size_t>(region_.height)) {}

bool Film::add(int x, int y, const Sample& sample, bool first) {
    float sum = sample.alpha + sample.depth + sample.normal[0] + sample.normal[1] + sample.normal[2];
    for (const auto& c : sample.radiance) sum += c[0] + c[1] + c[2];
    if (!std::isfinite(sum)) return false;
    Pixel& p = pixels_[static_cast<std::size_t>(y - region_.y) * region_.width + (x - region_.x)];
    for (int c = 0; c < k_classes; ++c) {
        for (int k = 0; k < 3; ++k) p.radiance[c][k] += sample.radiance[c][k];
    }
    p.alpha += sample.alpha;
    if (first) p.depth = sample.depth;
    for (int k = 0; k < 3; ++k) p.normal[k] += sample.normal[k];
    ++p.samples;
    return true;
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
    return f;
}

void Film::resolve(const Region& part, Frame& frame) const {
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
                    const float mean = p.radiance[c][k] * inv * exposure_;
                    frame.passes[pass_classes + c].data[3 * i + k] = mean;
                    sum += mean;
                }
                combined[k] = sum;
                frame.passes[pass_normal].data[3 * i + k] = p.normal[k] * inv;
            }
            combined[3] = transparent_ ? std::clamp(p.alpha * inv, 0.0f, 1.0f) : 1.0f;
            frame.passes[pass_depth].data[i] = p.depth;
        }
    }
}

}  // namespace cardioid::film
