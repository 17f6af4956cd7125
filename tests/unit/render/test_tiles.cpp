// SPDX-License-Identifier: GPL-3.0-or-later
#include "path/batch.h"
#include "render/passes.h"
#include "render/tiles.h"

#include <gtest/gtest.h>

namespace cardioid::render {
namespace {

TEST(Passes, CoverEverySampleOnceInTheSameTable) {
    for (const int most : {1, 2, 4, 8}) {
        const auto whole = passes(0, 300, most);
        for (int first = 0; first < 40; ++first) {
            for (int samples = 0; samples <= 100; ++samples) {
                int next = first;
                for (const Pass& p : passes(first, samples, most)) {
                    EXPECT_EQ(p.first, next);
                    next += p.samples;
                    EXPECT_GE(p.samples, 1);
                    EXPECT_LE(p.size, most);
                    const Pass& same = whole[static_cast<std::size_t>(p.number)];
                    ASSERT_TRUE(same.number == p.number && same.begin == p.begin && same.size == p.size);
                    EXPECT_TRUE(p.first >= p.begin && p.first + p.samples <= p.begin + p.size);
                }
                EXPECT_EQ(next, first + samples);
            }
        }
        EXPECT_EQ(whole.front().samples, 1) << "the first picture comes fast";
    }
    EXPECT_TRUE(passes(0, -1).empty());
}

/// Pixels of the region that are not in exactly one tile, or tiles that leave it or a batch's size.
int faults(const film::Region& region, const std::vector<film::Region>& list, int samples) {
    std::vector<int> covered(static_cast<std::size_t>(region.width * region.height), 0);
    int wrong = 0;
    for (const film::Region& t : list) {
        if (t.width < 1 || t.height < 1 || t.width * t.height * samples > path::k_batch || t.width > 64 ||
            t.height > 64)
            ++wrong;
        for (int y = t.y; y < t.y + t.height; ++y) {
            for (int x = t.x; x < t.x + t.width; ++x) {
                const bool inside =
                    x >= region.x && y >= region.y && x < region.x + region.width && y < region.y + region.height;
                if (!inside)
                    ++wrong;
                else
                    ++covered[static_cast<std::size_t>((y - region.y) * region.width + x - region.x)];
            }
        }
    }
    for (const int n : covered) wrong += n != 1;
    return wrong;
}

TEST(Tiles, CoverEveryPixelOnce) {
    for (const int width : {1, 2, 7, 15, 16, 17, 31, 32, 33, 100, 257}) {
        for (const int height : {1, 3, 8, 9, 16, 33, 64, 101}) {
            for (int samples = 1; samples <= 8; ++samples) {
                for (const auto& [x, y] : {std::pair{0, 0}, {5, 11}}) {
                    const film::Region region{x, y, width, height};
                    ASSERT_EQ(faults(region, tiles(region, samples), samples), 0)
                        << width << " × " << height << ", " << samples;
                }
            }
        }
    }
}

TEST(Tiles, TheCountNoticesFaults) {
    const film::Region region{0, 0, 40, 40};
    auto list = tiles(region, 1);
    ++list[1].x;
    EXPECT_GT(faults(region, list, 1), 0);
    list = tiles(region, 1);
    list.pop_back();
    EXPECT_GT(faults(region, list, 1), 0);
    EXPECT_GT(faults(region, tiles(region, 1), 8), 0) << "tiles for one sample are too large for eight";
}

TEST(Tiles, FromTheTopOfThePicture) {
    const auto list = tiles({0, 0, 64, 64}, 1);
    EXPECT_EQ(list.front().y + list.front().height, 64);
    EXPECT_EQ(list.back().y, 0);
}

}  // namespace
}  // namespace cardioid::render
