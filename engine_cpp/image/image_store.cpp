// SPDX-License-Identifier: GPL-3.0-or-later
#include "image/image_store.h"

#include "image/picture.h"
#include "image/sampler.h"
#include "scene/error.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

namespace cardioid::image {
namespace {

constexpr std::int64_t k_megabyte = 1 << 20;
constexpr int k_smallest_cache_mb = 16;

/// The reader's own cache serves tiled and very large files only; our tiles get the rest.
int reader_share(int cache_mb) { return std::max(std::max(cache_mb, k_smallest_cache_mb) / 8, 4); }

/// As scene/validate.h names an image, so that one problem is not reported twice in different words.
std::string label_of(const std::string& name, std::size_t index) {
    return name.empty() ? "image " + std::to_string(index) : "image \"" + name + '"';
}

/// Runs task(0…count-1) on all processors.
template <class Task>
void in_parallel(std::size_t count, Task task) {
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t i = next++; i < count; i = next++) task(i);
    };
    const std::size_t threads = std::min<std::size_t>({count, std::max(std::thread::hardware_concurrency(), 1u), 16});
    std::vector<std::jthread> others;
    for (std::size_t t = 1; t < threads; ++t) others.emplace_back(work);
    work();
}

}  // namespace

struct ImageStore::Impl {
    FileCache files;
    SpillFile spill;
    std::vector<std::unique_ptr<Picture>> pictures;
    std::unique_ptr<Picture> missing = std::make_unique<Picture>();
    TileCache tiles;  // after the pictures, whose tiles it frees
    ColorSpaces spaces;
    SrgbTable srgb;
    std::vector<std::once_flag> mean_once;
    std::vector<Float3> means;
    mutable std::mutex warnings_mutex;
    std::vector<std::string> warnings;

    Impl(const std::vector<scene::ImageDesc>& images, const std::string& ocio_config, int cache_mb)
        : files(reader_share(cache_mb)),
          pictures(images.size()),
          tiles((std::max(cache_mb, k_smallest_cache_mb) - reader_share(cache_mb)) * k_megabyte),
          spaces(ocio_config),
          mean_once(images.size()),
          means(images.size()) {
        open(images);
        plan();
        read_ahead();
        for (const auto& picture : pictures)
            if (picture->non_finite() > 0)
                warn(picture->label() + " has " + std::to_string(picture->non_finite()) +
                     " pixels that are not finite; black is used");
    }

    void warn(std::string message) {
        const std::lock_guard lock(warnings_mutex);
        if (std::find(warnings.begin(), warnings.end(), message) == warnings.end())
            warnings.push_back(std::move(message));
    }

    void open(const std::vector<scene::ImageDesc>& images) {
        std::vector<std::unique_ptr<Source>> sources(images.size());
        std::vector<std::string> problems(images.size());
        in_parallel(images.size(), [&](std::size_t i) {
            try {
                sources[i] = open_source(images[i], files);
            } catch (const std::exception& error) { problems[i] = error.what(); }
        });
        std::set<std::string> unknown;
        for (std::size_t i = 0; i < images.size(); ++i) {
            if (!sources[i]) {
                warn(label_of(images[i].name, i) + ' ' + problems[i] + "; shown magenta");
                pictures[i] = std::make_unique<Picture>();
                continue;
            }
            ColorSpace space = spaces.find(images[i].colorspace, sources[i]->info().storage >= Storage::half);
            if (!space.known) unknown.insert(images[i].colorspace);
            pictures[i] = std::make_unique<Picture>(images[i], label_of(images[i].name, i), std::move(sources[i]),
                                                    std::move(space));
        }
        if (!unknown.empty()) warn_of_spaces(unknown);
    }

    void warn_of_spaces(const std::set<std::string>& unknown) {
        std::string names;
        for (const std::string& name : unknown) names += (names.empty() ? "\"" : ", \"") + name + '"';
        std::string message = "colour spaces that cannot be converted, read as sRGB or linear: " + names;
        if (!spaces.config_problem().empty())
            message += " (the colour configuration cannot be used: " + spaces.config_problem() + ')';
        warn(std::move(message));
    }

    /// While everything fits, nothing is ever dropped, and no use of a tile is noted.
    void plan() {
        std::int64_t total = 0;
        for (const auto& picture : pictures) total += picture->texture().bytes();
        for (const auto& picture : pictures) {
            if (total > tiles.budget() && picture->repeatable()) picture->make_evictable(spill);
            tiles.add(picture->texture());
        }
        tiles.add(missing->texture());
    }

    void read_ahead() {
        std::vector<Picture*> first;
        std::int64_t sum = 0;
        for (const auto& picture : pictures) {
            const std::int64_t bytes = picture->texture().bytes();
            // What cannot be read again must be read now.
            if (picture->repeatable() && (picture->in_parts() || sum + bytes > tiles.budget() * 3 / 4)) continue;
            sum += bytes;
            first.push_back(picture.get());
        }
        in_parallel(first.size(), [&](std::size_t i) { load(*first[i], 0); });
        load(*missing, 0);
        for (const auto& picture : pictures)
            if (!picture->repeatable()) picture->forget_source();
    }

    void load(Picture& picture, int tile) {
        if (const std::string problem = picture.load(tile, tiles); !problem.empty())
            warn(picture.label() + ' ' + problem + "; shown magenta");
    }

    Picture& picture(int image) const {
        return image >= 0 && image < static_cast<int>(pictures.size()) ? *pictures[static_cast<std::size_t>(image)]
                                                                       : *missing;
    }

    Float3 mean(const ImageStore& store, int image) const;
};

ImageStore::ImageStore(const std::vector<scene::ImageDesc>& images, const std::string& ocio_config, int cache_mb)
    : impl_(std::make_unique<Impl>(images, ocio_config, cache_mb)) {}
ImageStore::~ImageStore() = default;

void ImageStore::lookup(int image, Interpolation interpolation, Extension extension, int n, const float* u,
                        const float* v, Row rgba[4], AlphaUse alpha) const {
    Picture& picture = impl_->picture(image);
    const Texture& texture = picture.texture();
    Footprint footprint;
    place(footprint, interpolation, extension, texture.width, texture.height, n, u, v);
    Quad colors[k_chunk];
    ReaderLock::Reading reading(impl_->tiles.lock());
    for (int done = 0;;) {
        int missing = 0;
        done = fetch(texture, footprint, done, n, colors, missing);
        if (done == n) break;
        reading.leave();
        impl_->load(picture, missing);
        reading.enter();
    }
    finish(texture, impl_->srgb, alpha, n, colors, rgba);
}

int ImageStore::width(int image) const { return impl_->picture(image).texture().width; }
int ImageStore::height(int image) const { return impl_->picture(image).texture().height; }
bool ImageStore::has_alpha(int image) const { return impl_->picture(image).has_alpha(); }
int ImageStore::size() const { return static_cast<int>(impl_->pictures.size()); }
std::int64_t ImageStore::memory_bytes() const { return impl_->tiles.bytes() + impl_->files.memory_bytes(); }

std::vector<std::string> ImageStore::warnings() const {
    const std::lock_guard lock(impl_->warnings_mutex);
    return impl_->warnings;
}

Float3 ImageStore::mean_color(int image) const {
    if (image < 0 || image >= size()) return {1, 0, 1};
    const auto index = static_cast<std::size_t>(image);
    std::call_once(impl_->mean_once[index], [&] { impl_->means[index] = impl_->mean(*this, image); });
    return impl_->means[index];
}

Float3 ImageStore::Impl::mean(const ImageStore& store, int image) const {
    const int width = store.width(image), height = store.height(image);
    // 16 million texels are looked at; of larger images a regular part.
    const int step = std::max(1, static_cast<int>(std::ceil(std::sqrt(double(width) * height / 16e6))));
    double sum[3] = {0, 0, 0}, count = 0;
    float u[k_chunk], v[k_chunk];
    Row rgba[4];
    int n = 0;
    const auto flush = [&] {
        store.lookup(image, Interpolation::closest, Extension::extend, n, u, v, rgba, AlphaUse::associated);
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < n; ++i) sum[c] += static_cast<double>(rgba[c][i]);
        count += n;
        n = 0;
    };
    // Tile by tile, so that a cache smaller than the image reads every tile once.
    for (int ty = 0; ty < height; ty += k_tile)
        for (int tx = 0; tx < width; tx += k_tile)
            for (int y = ty; y < std::min(ty + k_tile, height); y += step)
                for (int x = tx; x < std::min(tx + k_tile, width); x += step) {
                    u[n] = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
                    v[n] = (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
                    if (++n == k_chunk) flush();
                }
    if (n > 0) flush();
    return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count), static_cast<float>(sum[2] / count)};
}

}  // namespace cardioid::image
