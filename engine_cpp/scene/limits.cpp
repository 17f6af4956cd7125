// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene/limits.h"

#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>

namespace cardioid::scene {
namespace {

// The film sums 36 values a pixel (film/film.h); a picture has 23, and one is published while the next is made.
constexpr std::int64_t k_film_bytes_per_pixel = (36 + 2 * 23) * 4;
// Raw, Filtered and Withheld in both pictures, and what a filter run returns.
constexpr std::int64_t k_filtered_bytes_per_pixel = (2 * 9 + 6) * 4;
// Clusters of 32 bytes. Measured where glossy and diffuse light mix: 330 bytes a pixel at 16 samples, 480 at 64, 670 at 1024.
constexpr std::int64_t k_cluster_bytes_per_pixel = 500, k_cluster_bytes_per_sample = 3 * 32;
// Half sums in the film and with the rules (render/adaptive.h), and flags.
constexpr std::int64_t k_adaptive_bytes_per_pixel = 12 + 32 + 2;
// The per-pixel schedule's statistics (photon/radius.h) and means in the film.
constexpr std::int64_t k_radius_bytes_per_pixel = 56 + 48;
// Embree's tree with its triangles copied into the leaves, 8 wide.
constexpr std::int64_t k_tree_bytes_per_triangle = 120;
constexpr std::int64_t k_bytes_per_instance = 700;
// An emitted photon is stored about once where emission is guided: 48 bytes as it is traced, again in the index, and its cells.
constexpr std::int64_t k_bytes_per_photon = 150;
constexpr std::int64_t k_huge = std::numeric_limits<std::int64_t>::max() / 8;

std::int64_t times(std::int64_t a, std::int64_t b) {
    std::int64_t product = 0;
    return __builtin_mul_overflow(a, b, &product) ? k_huge : std::min(product, k_huge);
}

template <class T>
std::int64_t bytes(const std::vector<T>& values) {
    return static_cast<std::int64_t>(values.size() * sizeof(T));
}

std::int64_t mesh_bytes(const MeshDesc& mesh) {
    std::int64_t arrays = bytes(mesh.positions) + bytes(mesh.triangles) + bytes(mesh.slots) +
                          bytes(mesh.corner_normals) + bytes(mesh.edges);
    for (const AttributeDesc& attribute : mesh.attributes) arrays += bytes(attribute.data);
    // The description stays alive beside the built tables.
    return 2 * arrays + static_cast<std::int64_t>(mesh.triangles.size() / 3) * k_tree_bytes_per_triangle;
}

std::string readable(std::int64_t amount) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f GB", static_cast<double>(amount) / (1024.0 * 1024 * 1024));
    return text;
}

/// Of film and pictures.
std::int64_t bytes_per_pixel(const Settings& s) {
    std::int64_t sum = k_film_bytes_per_pixel;
    if (s.record_clusters || s.filter.use_filter) {
        const std::int64_t few = k_cluster_bytes_per_sample * std::max(s.samples, 1);
        sum += k_filtered_bytes_per_pixel + std::min(k_cluster_bytes_per_pixel, few);
    }
    if (s.adaptive_threshold > 0) sum += k_adaptive_bytes_per_pixel;
    const bool photons = s.integrator != IntegratorKind::path_tracing;
    if (photons && s.radius_schedule == RadiusSchedule::per_pixel) sum += k_radius_bytes_per_pixel;
    return sum;
}

}  // namespace

std::int64_t MemoryEstimate::total() const { return geometry + film + photons + textures; }

MemoryEstimate memory_estimate(const SceneDesc& scene) {
    MemoryEstimate estimate;
    for (const MeshDesc& mesh : scene.meshes) estimate.geometry += mesh_bytes(mesh);
    std::size_t instances = scene.instances.size();
    for (const GroupDesc& group : scene.groups) instances += group.instances.size();
    estimate.geometry += times(static_cast<std::int64_t>(instances), k_bytes_per_instance);

    bool cached = false;
    for (const ImageDesc& image : scene.images) {
        estimate.textures += bytes(image.pixels) + bytes(image.packed);
        cached = cached || image.source != ImageSource::pixels;
    }
    if (cached) estimate.textures += times(std::max(scene.settings.texture_cache_mb, 0), std::int64_t{1} << 20);

    const Settings& s = scene.settings;
    const bool cropped = s.crop[2] > 0 && s.crop[3] > 0;
    const std::int64_t width = std::max(cropped ? s.crop[2] : s.width, 0),
                       height = std::max(cropped ? s.crop[3] : s.height, 0);
    estimate.film = times(times(width, height), bytes_per_pixel(s));
    if (s.integrator != IntegratorKind::path_tracing) estimate.photons = times(s.photons, k_bytes_per_photon);
    return estimate;
}

std::int64_t machine_memory() {
    std::int64_t memory = static_cast<std::int64_t>(::sysconf(_SC_PHYS_PAGES)) * ::sysconf(_SC_PAGE_SIZE);
    for (const char* path : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
        std::ifstream file(path);
        std::int64_t limit = 0;
        if (file >> limit && limit > 0) memory = std::min(memory, limit);
    }
    return memory;
}

std::string memory_problem(const SceneDesc& scene) {
    const MemoryEstimate estimate = memory_estimate(scene);
    const Settings& s = scene.settings;
    // The tile cache gives way to what is needed, so it is not held against the scene.
    const std::int64_t need = estimate.geometry + estimate.film + estimate.photons;
    const bool limited = s.memory_limit > 0;
    const std::int64_t have = limited ? s.memory_limit : machine_memory();
    if (need <= have) return {};
    const std::string photons =
        estimate.photons > 0 ? ", " + readable(estimate.photons) + " for " + std::to_string(s.photons) + " photons"
                             : "";
    return "the scene needs about " + readable(need) + " (" + readable(estimate.film) + " for " +
           std::to_string(s.width) + " × " + std::to_string(s.height) + " pixels, " + readable(estimate.geometry) +
           " for geometry" + photons + "), but " + (limited ? "the memory limit is " : "this machine has ") +
           readable(have);
}

}  // namespace cardioid::scene
