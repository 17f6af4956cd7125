# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutants of clusters and film files. Texts must occur exactly once in the file."""

TESTS = {"test_film": "*"}

MUTANTS = [
    dict(
        name="insertion at the end",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("        move(clusters + at, clusters + at + 1);\n", "")],
        tests=TESTS,
    ),
    dict(
        name="merge forgets I",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("    sums.incident += other.incident;\n", "")],
        tests=TESTS,
    ),
    dict(
        name="merge forgets N",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("    sums.samples += other.samples;\n", "")],
        tests=TESTS,
    ),
    dict(
        name="merge forgets R",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("    for (int k = 0; k < 3; ++k) sums.radiance[k] += other.radiance[k];\n", "")],
        tests=TESTS,
    ),
    dict(
        name="merge keeps the old bound",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("    a.max = clusters[best + 1].max;\n", "")],
        tests=TESTS,
    ),
    dict(
        name="merge by gap alone",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("k_gradient_weight * std::abs(here - next)", "0 * std::abs(here - next)")],
        tests=TESTS,
    ),
    dict(
        name="gradient over N",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("static_cast<float>(c.samples - 1)", "static_cast<float>(c.samples)")],
        tests=TESTS,
    ),
    dict(
        name="first batch by clusters",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("taken < k_first_batch ? 0.0f", "std::min<int>(list.count, static_cast<int>(taken)) < 4 ? 0.0f")],
        tests=TESTS,
    ),
    dict(
        name="first neighbour instead of the nearest",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("joins && below <= above ? at - 1 : at", "joins && at > 0 ? at - 1 : at")],
        tests=TESTS,
    ),
    dict(
        name="reach by the cluster",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("k_join * incident", "k_join * (at > 0 ? clusters[at - 1].max : incident)")],
        tests=TESTS,
    ),
    dict(
        name="joining does not widen",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("    c.max = std::max(c.max, incident);\n", "")],
        tests=TESTS,
    ),
    dict(
        name="nine clusters",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("if (list.count > k_max_clusters) merge", "if (list.count > k_max_clusters + 1) merge")],
        tests=TESTS,
    ),
    dict(
        name="black samples enter",
        file="engine_cpp/film/cluster_store.h",
        edits=[("if (!(incident > 0 && ", "if (!(incident >= 0 && ")],
        tests=TESTS,
    ),
    dict(
        name="infinite samples enter",
        file="engine_cpp/film/cluster_store.h",
        edits=[
            (
                "if (!(incident > 0 && incident <= std::numeric_limits<float>::max())) return false;",
                "if (!(incident > 0)) return false;",
            )
        ],
        tests=TESTS,
    ),
    dict(
        name="never collapsed",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("if (!apart) collapse(list);", "(void)apart;")],
        tests=TESTS,
    ),
    dict(
        name="collapse only at first",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("list.collapsed && !(i > 0 && within_reach(clusters[i - 1], c)) &&", "list.collapsed ||")],
        tests=TESTS,
    ),
    dict(
        name="collapse in the first batch",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("if (taken >= k_first_batch) {", "if (taken >= 1) {")],
        tests=TESTS,
    ),
    dict(
        name="blocks stay though a pixel is unchanged",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("const bool stays = all_changed && room", "const bool stays = room")],
        tests=TESTS,
    ),
    dict(
        name="lost at a block's border",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("    put_back();\n    ClusterStore::Block& block", "    ClusterStore::Block& block")],
        tests=TESTS,
    ),
    dict(
        name="negative light lost",
        file="engine_cpp/film/film.cpp",
        edits=[("if (!kept) accumulate(p.unfiltered, sample.layers[l].radiance);", "(void)kept;")],
        tests=TESTS,
    ),
    dict(
        name="NaN in a layer passes",
        file="engine_cpp/film/film.cpp",
        edits=[("sum += total(l.radiance) + total(l.incident);", "sum += total(l.radiance);")],
        tests=TESTS,
    ),
    dict(
        name="clusters unchecked on load",
        file="engine_cpp/film/film_file.cpp",
        edits=[("if (!valid(", "if (false && !valid(")],
        tests=TESTS,
    ),
    dict(
        name="pixels unchecked on load",
        file="engine_cpp/film/film_file.cpp",
        edits=[("if (!all_finite(film.pixels_)", "if ((false && !all_finite(film.pixels_))")],
        tests=TESTS,
    ),
    dict(
        name="checksum not compared",
        file="engine_cpp/film/film_file.cpp",
        edits=[("if (stored != sum)", "if (false && stored != sum)")],
        tests=TESTS,
    ),
    dict(
        name="size not compared",
        file="engine_cpp/film/film_layout.cpp",
        edits=[('    if (size < need) throw SceneError("is truncated");\n', "")],
        tests=TESTS,
    ),
    dict(
        name="memory not compared",
        file="engine_cpp/film/film_layout.cpp",
        edits=[("if (need > static_cast<std::uint64_t>(scene::machine_memory()))", "if (false)")],
        tests=TESTS,
    ),
    dict(
        name="disjointness unchecked",
        file="engine_cpp/film/cluster_store.cpp",
        edits=[("if (!(c.min > above)", "if (!(c.min >= above)")],
        tests=TESTS,
    ),
    dict(
        name="neighbours stay apart after the first batch",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("if (!apart) collapse(list);", "(void)apart;")],
        tests=TESTS,
    ),
    dict(
        name="collapse from the start",
        file="engine_cpp/film/cluster_editor.cpp",
        edits=[("if (taken >= k_first_batch) {", "if (taken >= 1) {")],
        tests=TESTS,
    ),
]
