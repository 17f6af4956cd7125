# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the filter must notice. Run by scripts/mutants.py --table; see caustics.py for the format."""

REJECT = "test_reject"
FILTER = "test_filter"

MUTANTS = [
    dict(
        name="stretch of the wrong cluster",
        file="engine_cpp/filter/reject.cpp",
        edits=[
            (
                "{range.low * (1 - sensitivity_), range.high * (1 + sensitivity_)}",
                "{range.low / (1 + sensitivity_), range.high / (1 - sensitivity_)}",
            )
        ],
        tests={REJECT: "Reject.OnlyTheTestedClusterIsStretched"},
    ),
    dict(
        name="rejected clusters excuse dimmer ones",
        file="engine_cpp/filter/reject.cpp",
        edits=[
            (
                "            ++stats.rejected;\n",
                "            ++stats.rejected;\n            accepted = std::max(accepted, c.measure.range.high);\n",
            )
        ],
        tests={REJECT: "Reject.DimmerThanWhatStaysStays"},
    ),
    dict(
        name="a brightest for each layer",
        file="engine_cpp/filter/reject.cpp",
        edits=[("        std::int64_t found = 0;\n", "        std::int64_t found = 0;\n        accepted = 0;\n")],
        tests={REJECT: "Reject.DimmerThanWhatStaysStays"},
    ),
    dict(
        name="evidence from another layer",
        file="engine_cpp/filter/reject.cpp",
        edits=[
            ("if (q.brightest[layer] * std::max(texture, 1.0f) < like.low) continue;", ""),
            (
                "clusters_.view(qx, qy, layer), like, texture);",
                "clusters_.view(qx, qy, layer < 2 ? 2 : 2), like, texture);",
            ),
        ],
        tests={REJECT: "Reject.OnlyLikeSamplesOfTheSameLayerNearbyCount"},
    ),
    dict(
        name="the tested cluster counted twice",
        file="engine_cpp/filter/reject.cpp",
        edits=[("if (i != tested && own", "if (own")],
        tests={REJECT: "Reject.FourAlikeStayThreeGo"},
    ),
    dict(
        name="n not scaled at borders",
        file="engine_cpp/filter/reject_kernel.cpp",
        edits=[("std::min(at + half, size - 1) - std::max(at - half, 0) + 1;", "2 * half + 1 + 0 * (at + size);")],
        tests={REJECT: "Reject.DensityNotCountAtTheBorder"},
    ),
    dict(
        name="order of neighbours decides",
        file="engine_cpp/filter/reject.cpp",
        edits=[("        found += more;\n", "        found = std::max(found, more + k_evidence * step.dx);\n")],
        tests={REJECT: "Methods/RejectBy.FlipsAndTransposes/*"},
    ),
    dict(
        name="neighbours' numbers of samples ignored",
        file="engine_cpp/filter/reject.cpp",
        edits=[("if (q.samples > p.samples) {", "if (q.samples == 0) {")],
        tests={REJECT: "Reject.EvidenceOfPixelsWithOtherNumbersOfSamples"},
    ),
    dict(
        name="evidence of few samples multiplied",
        file="engine_cpp/filter/reject.cpp",
        edits=[("if (q.samples > p.samples) {", "if (q.samples != p.samples) {")],
        tests={REJECT: "Reject.EvidenceOfPixelsWithOtherNumbersOfSamples"},
    ),
    dict(
        name="wide clusters count whole",
        file="engine_cpp/filter/reject.cpp",
        edits=[("return rules_.whole ?", "return rules_.whole || m.evidence > 0 ?")],
        tests={REJECT: "Reject.WideNeighbourCountsInPart"},
    ),
    dict(
        name="density runs on always",
        file="engine_cpp/filter/reject.cpp",
        edits=[("(rules_.accumulate ? found : 0) +", "found +")],
        tests={REJECT: "Reject.RulesDifferAsPrinted"},
    ),
    dict(
        name="ranked by arriving light always",
        file="engine_cpp/filter/reject.cpp",
        edits=[("return rules_.incident ?", "return rules_.incident || c.samples > 0 ?")],
        tests={REJECT: "Reject.BrightnessIsWhatIsAdded"},
    ),
    dict(
        name="dim samples are evidence for a bright one",
        file="engine_cpp/filter/reject_measure.h",
        edits=[("std::min(sum * (sum / c.radiance_squared), samples);", "samples;")],
        tests={REJECT: "Reject.OneSampleDoesNotHideBehindThoseOfItsCluster"},
    ),
    dict(
        name="textures set pixels apart",
        file="engine_cpp/filter/reject.cpp",
        edits=[("p.detail > 0 && q.detail > 0 ?", "p.detail < 0 && q.detail > 0 ?")],
        tests={REJECT: "Reject.TexturesDoNotSetPixelsApart"},
    ),
    dict(
        name="literal division by the samples of clusters",
        file="engine_cpp/filter/thesis.cpp",
        edits=[("static_cast<double>(w * t.taken[q])", "static_cast<double>(w * g.count)")],
        tests={FILTER: "Thesis.EnergyAsModelled"},
    ),
    dict(
        name="pixels without the group's samples left out",
        file="engine_cpp/filter/thesis.cpp",
        edits=[
            (
                "            const float w = weight * poisson",
                "            if (g.count <= 0 && p != q) continue;\n            const float w = weight * poisson",
            )
        ],
        tests={FILTER: "Thesis.EnergyAsModelled"},
    ),
    dict(
        name="detail without misses",
        file="engine_cpp/film/film.cpp",
        edits=[
            (
                "f.detail[k] = p.detail[k] * inv;",
                "f.detail[k] = p.detail[k] / std::max(1.0f, std::hypot(p.normal[0], p.normal[1], p.normal[2]));",
            )
        ],
        tests={FILTER: "Methods/Edges.CoverageStays/*"},
    ),
    dict(
        name="order-dependent groups",
        file="engine_cpp/filter/thesis.cpp",
        edits=[("while (last != groups_.end() &&", "if (last != groups_.end() &&")],
        tests={FILTER: "Groups.*"},
    ),
    dict(
        name="counts not scaled to samples taken",
        file="engine_cpp/filter/thesis.cpp",
        edits=[("const float per_sample = t.taken[p] / t.taken[q];", "const float per_sample = 1;")],
        tests={FILTER: "Methods/Edges.PixelsOfMoreSamplesHelp/1"},
    ),
    dict(
        name="texture of the neighbour",
        file="engine_cpp/filter/thesis.cpp",
        edits=[("p == q ? 1.0f : t.detail[k][p] / t.detail[k][q]", "p == q ? 1.0f : 1.0f")],
        tests={FILTER: "Methods/Textured.ConstantLightLeavesIt/1"},
    ),
    dict(
        name="normals ignored",
        file="engine_cpp/filter/geometry.h",
        edits=[("return feature_distance(turned,", "return 0.0f * feature_distance(turned,")],
        tests={FILTER: "Methods/Light.DoesNotCrossNormalSteps/*"},
    ),
    dict(
        name="depths ignored",
        file="engine_cpp/filter/geometry.h",
        edits=[("feature_distance(away * away,", "0.0f * feature_distance(away * away,")],
        tests={FILTER: "Methods/Light.DoesNotCrossDepthSteps/*"},
    ),
    dict(
        name="depth not relative to its slope",
        file="engine_cpp/filter/geometry.h",
        edits=[("const Float tolerance = slope +", "const Float tolerance = 0.0f * slope +")],
        tests={FILTER: "Methods/Light.SlopesAreNoSteps/*"},
    ),
    dict(
        name="spread of samples within a pixel ignored",
        file="engine_cpp/filter/geometry.h",
        edits=[
            (
                "max(squared - variance, 0.0f) / max(tolerance_squared + variance, 1e-30f)",
                "(squared + 0.0f * variance) / max(tolerance_squared, 1e-30f)",
            )
        ],
        tests={FILTER: "Methods/Edges.*"},
    ),
    dict(
        name="cross-bilateral without texture",
        file="engine_cpp/filter/cross_bilateral.cpp",
        edits=[("texture_distance(t, p, q) * (0.5f", "texture_distance(t, p, q) * (0.0f")],
        tests={FILTER: "CrossBilateral.TexturesWithinItsWidthAreBlurred"},
    ),
    dict(
        name="withheld light left in the picture",
        file="engine_cpp/filter/filter.cpp",
        edits=[("    shown = raw - withheld;\n", "    shown = raw;\n")],
        tests={FILTER: "Exactly.RawIsShownAndWithheld"},
    ),
    dict(
        name="shown and withheld each rounded",
        file="engine_cpp/filter/filter.cpp",
        edits=[
            ("    withheld = raw - shown;\n", ""),
            ("    if (shown + withheld < raw) withheld = std::nextafter(withheld, INFINITY);\n", ""),
            ("    if (shown + withheld > raw) withheld = std::nextafter(withheld, -INFINITY);\n", ""),
        ],
        tests={FILTER: "Exactly.RawIsShownAndWithheld"},
    ),
    dict(
        name="mean over the samples of clusters",
        file="engine_cpp/filter/tile.cpp",
        edits=[
            (
                "        if ((withheld >> k & 1) != 0) continue;\n",
                "        if ((withheld >> k & 1) != 0) continue;\n"
                "        lit += static_cast<float>(clusters[k].samples);\n",
            ),
            ("mean[3], variance[3];\n    for (std::size_t k", "mean[3], variance[3], lit = 0;\n    for (std::size_t k"),
            ("mean[c] = sum[c] / taken[i];", "mean[c] = sum[c] / std::max(lit, 1.0f);"),
        ],
        tests={FILTER: "Models/Energy.*"},
    ),
    dict(
        name="noise explains nothing",
        file="engine_cpp/filter/similar.cpp",
        edits=[("return 0.5f * (vp + vq) + min(vp, vq);", "return 0.0f * (vp + vq);")],
        tests={FILTER: "Models/Energy.*:Methods/*/0"},
    ),
    dict(
        name="weights do not tighten",
        file="engine_cpp/filter/similar.cpp",
        edits=[("constexpr float k_alike_squared = 1e-7f;", "constexpr float k_alike_squared = 3e-2f;")],
        tests={FILTER: "Convergence.*"},
    ),
    dict(
        name="light is not divided by detail",
        file="engine_cpp/filter/tile.cpp",
        edits=[("bright ? mean[c] / d : 0.0f", "bright ? mean[c] : 0.0f")],
        tests={FILTER: "Methods/Textured.ConstantLightLeavesIt/0:Methods/ByClusters.TextureUnderNoisyLight/0"},
    ),
    dict(
        name="a firefly spread without bounds",
        file="engine_cpp/filter/spread.cpp",
        edits=[("constexpr float k_largest_share = 0.25f;", "constexpr float k_largest_share = 1e30f;")],
        tests={FILTER: "Methods/Edges.HugeValuesStayWhereTheyAre/0"},
    ),
    dict(
        name="withheld light is not spread",
        file="engine_cpp/filter/spread.cpp",
        edits=[("constexpr float k_largest_share = 0.25f;", "constexpr float k_largest_share = 0;")],
        tests={FILTER: "Withheld.*"},
    ),
]
