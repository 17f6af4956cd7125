# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of caustics must notice. Run by scripts/mutants.py; one mutant a row: the file, texts that
occur exactly once in it with what takes their place, and the tests of each program that are to fail."""

EQUIVALENCE = "test_caustics_equivalence"
CLOSED_FORM = "test_caustics_closed_form"
THRESHOLD = "test_caustics_threshold"

MUTANTS = [
    dict(
        name="forget C2",
        file="engine_cpp/path/partition.h",
        edits=[("if (s.indirect_caustics == scene::IndirectCaustics::photons) p.photons |= c2;", "")],
        tests={EQUIVALENCE: "Equivalence.GlassAndChromeHybrid"},
    ),
    dict(
        name="store at L D",
        file="engine_cpp/path/automaton.h",
        edits=[
            ("case PhotonState::diffuse: return PathClass::d2;", "case PhotonState::diffuse: return PathClass::c1;")
        ],
        tests={EQUIVALENCE: "Equivalence.GlassAndChromeHybrid"},
    ),
    dict(
        name="store after roulette",
        file="engine_cpp/path/photon_scatter.cpp",
        edits=[
            ("if (any(stores)) keep(ray, i, path_class, stores);", ""),
            (
                "c.valid &= chance.x < survive;",
                "c.valid &= chance.x < survive;\n"
                "        if (any(stores & c.valid)) keep(ray, i, path_class, stores & c.valid);",
            ),
        ],
        tests={EQUIVALENCE: "Equivalence.GlassBulbHybrid:Equivalence.BouncingCausticHybrid"},
    ),
    dict(
        name="stop at the first store",
        file="engine_cpp/path/photon_scatter.cpp",
        edits=[
            (
                "c.valid &= may_be_stored(next_state, request.classes);",
                "c.valid &= may_be_stored(next_state, request.classes) & ~stores;",
            )
        ],
        tests={EQUIVALENCE: "Equivalence.BouncingCausticHybrid"},
    ),
    dict(
        name="gather at the second D",
        file="engine_cpp/path/gather.cpp",
        edits=[
            (
                "c.took_d & (state == Int(static_cast<int>(path::State::specular)))",
                "c.took_d & (state == Int(static_cast<int>(path::State::first_d)))",
            )
        ],
        tests={EQUIVALENCE: "Equivalence.GlassAndChromeHybrid"},
    ),
    dict(
        name="gather at every D",
        file="engine_cpp/path/gather.cpp",
        edits=[("c.took_d & (state == Int(static_cast<int>(path::State::specular)))", "c.took_d & (state == state)")],
        tests={EQUIVALENCE: "Equivalence.GlassAndChromeHybrid"},
    ),
    dict(
        name="gather without 1/P(D)",
        file="engine_cpp/path/gather.cpp",
        edits=[
            (
                "const Float inv_p = 1.0f / max(probability_d, 1e-20f);",
                "const Float inv_p = 1.0f + 0.0f * probability_d;",
            )
        ],
        tests={EQUIVALENCE: "Equivalence.HalfMirrorFloor*"},
    ),
    dict(
        name="cos_s without /cos_g",
        file="engine_cpp/path/gather.cpp",
        edits=[("stride / max(abs(dot(q.wp, q.normal)), 1e-4f)", "stride")],
        tests={EQUIVALENCE: "Equivalence.CoarseReceiver*"},
    ),
    dict(
        name="shading cosine for the geometric",
        file="engine_cpp/path/gather.cpp",
        edits=[
            (
                "stride / max(abs(dot(q.wp, q.normal)), 1e-4f)",
                "stride / max(abs(dot(q.wp, load3(chunk.lobe[0].normal, i))), 1e-4f)",
            )
        ],
        tests={EQUIVALENCE: "Equivalence.CoarseReceiver*"},
    ),
    dict(
        name="shading normals not swapped",
        file="engine_cpp/path/bsdf_choice.h",
        edits=[("value * (geometric * refraction_scale", "value * ((0.0f * geometric + 1.0f) * refraction_scale")],
        tests={EQUIVALENCE: "Equivalence.Coarse*Ball*"},
    ),
    dict(
        name="eta² on no side",
        file="engine_cpp/path/bsdf_choice.h",
        edits=[("refraction_scale(lobe, i, wi, ng, !physical)", "refraction_scale(lobe, i, wi, ng, false)")],
        tests={EQUIVALENCE: "Equivalence.UnderWater*"},
    ),
    dict(
        name="eta² on both sides",
        file="engine_cpp/path/bsdf_choice.h",
        edits=[("refraction_scale(lobe, i, wi, ng, !physical)", "refraction_scale(lobe, i, wi, ng, true)")],
        tests={EQUIVALENCE: "Equivalence.UnderWater*"},
    ),
    dict(
        name="missed pixels not counted",
        file="engine_cpp/film/film.cpp",
        edits=[
            (
                "[channel] / static_cast<float>(pixels_[i].samples);",
                "[channel] / (path_class < 3 || pixels_[i].alpha <= 0 ? static_cast<float>(pixels_[i].samples) : "
                "pixels_[i].alpha);",
            )
        ],
        tests={EQUIVALENCE: "Equivalence.CoarseReceiver*"},
    ),
    dict(
        name="normalise by stored photons",
        file="engine_cpp/render/photon_stage.cpp",
        edits=[("s.pass.emitted = static_cast<float>(emitted);", "s.pass.emitted = static_cast<float>(stored);")],
        tests={EQUIVALENCE: "Equivalence.GlassBulbHybrid"},
    ),
    dict(
        name="rough-S connections dropped",
        file="engine_cpp/path/direct.cpp",
        edits=[
            (
                "const Mask rough_specular = lit & not_black(f.s) & before_d;",
                "const Mask rough_specular = lit & mask_of(false);",
            )
        ],
        tests={THRESHOLD: "Threshold.HighlightsStay:Threshold.PointLampOverMetal"},
    ),
    dict(
        name="depth limit of the photon alone",
        file="engine_cpp/path/gather.cpp",
        edits=[("camera_bounces + byte_of(q.depth, 0) <=", "camera_bounces * Int(0) + byte_of(q.depth, 0) <=")],
        tests={EQUIVALENCE: "BounceLimits.InAll"},
    ),
    dict(
        name="depth limit by kind of the photon alone",
        file="engine_cpp/path/gather.cpp",
        edits=[("byte_of(camera, 3) + byte_of(photon, 3) + t", "byte_of(camera, 3) * Int(0) + byte_of(photon, 3) + t")],
        tests={EQUIVALENCE: "BounceLimits.ByKind"},
    ),
    dict(
        name="photons not weighed against hits",
        file="engine_cpp/path/gather.cpp",
        edits=[("weight * (photons / max(photons + merge, 1e-37f))", "weight * (photons / max(photons, 1e-37f))")],
        tests={EQUIVALENCE: "Equivalence.GlassBulbHybrid:Equivalence.GlassAndChromeHybrid"},
    ),
]
