// SPDX-License-Identifier: GPL-3.0-or-later
// docs/nodes.md carries the table of the nodes that the compiler knows. CARDIOID_UPDATE_DOCS=1 writes it anew.
#include "nodes/node_types.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace cardioid {
namespace {

constexpr const char* k_begin = "<!-- nodes: generated from engine_cpp/nodes by tests/unit/nodes/docs_test.cpp -->\n";
constexpr const char* k_end = "<!-- nodes: end -->\n";

std::string read(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

TEST(Docs, ListTheNodesThatAreSupported) {
    const std::string path = CARDIOID_NODES_DOC;
    std::string text = read(path);
    const std::size_t begin = text.find(k_begin), end = text.find(k_end);
    ASSERT_NE(begin, std::string::npos);
    ASSERT_NE(end, std::string::npos);
    const std::size_t start = begin + std::string(k_begin).size();
    const std::string table = nodes::node_table_markdown();
    if (std::getenv("CARDIOID_UPDATE_DOCS") != nullptr) {
        text.replace(start, end - start, table);
        std::ofstream(path) << text;
    } else {
        EXPECT_EQ(text.substr(start, end - start), table) << "run this test with CARDIOID_UPDATE_DOCS=1";
    }
}

}  // namespace
}  // namespace cardioid
