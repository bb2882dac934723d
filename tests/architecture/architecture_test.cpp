// Who may know whom, as docs/architecture.md says.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

/// Per folder: the parts of ours that it may include, and the prefixes of others' headers.
struct Rule {
    std::set<std::string> parts;
    std::vector<std::string> others;
};

const std::map<std::string, Rule>& rules() {
    static const std::map<std::string, Rule> table{
        {"libs/core", {{"core"}, {}}},
        {"libs/recorder", {{"core", "recorder"}, {"sys/mman.h"}}},
        {"libs/query", {{"core", "query"}, {"re2/"}}},
        {"libs/probe", {{"core", "probe"}, {}}},
        {"libs/protocol", {{"core", "protocol"}, {"flatbuffers/", "emca_generated.h"}}},
        {"libs/server", {{"core", "recorder", "query", "protocol", "server"}, {"asio", "dlfcn.h"}}},
        {"libs/c", {{"core", "recorder", "server", "adapter", "probe", "c", "emca.h"}, {"stdbool.h", "stddef.h", "stdint.h"}}},
        {"libs/adapter", {{"core", "recorder", "server", "probe", "adapter"}, {"pthread.h", "signal.h"}}},
        {"libs/client", {{"core", "protocol", "client"}, {"asio", "zstd.h", "zlib.h", "fcntl.h", "unistd.h"}}},
        {"libs/imageio", {{"core", "imageio"}, {"OpenEXR/", "OpenImageIO/", "jpeglib.h", "dlfcn.h", "link.h"}}},
        {"libs/analysis", {{"core", "query", "analysis"}, {"boost/"}}},
        {"libs/doctor", {{"core", "client", "analysis", "probe", "doctor"}, {"fmt/"}}},
        {"libs/render", {{"core", "recorder", "imageio", "probe", "render"}, {"embree3/", "embree4/", "tbb/", "pugixml.hpp", "zlib.h"}}},
        {"apps/render", {{"core", "recorder", "imageio", "probe", "render", "server", "adapter"}, {"CLI/", "fmt/", "unistd.h", "sys/ioctl.h"}}},
        {"apps/cli", {{"core", "client", "query", "analysis", "imageio", "doctor"}, {"CLI/", "fmt/", "nlohmann/", "unistd.h", "sys/"}}},
        {"apps/explorer", {{"core", "client", "query", "analysis", "imageio", "probe", "explorer"}, {"Q", "qwt", "vtk", "CLI/", "fmt/", "unistd.h", "fcntl.h", "signal.h"}}},
        {"plugins", {{"core", "client", "query", "analysis", "imageio", "probe", "explorer"}, {"Q"}}},
        // What they include of their renderers is theirs to say.
        {"integrations", {{"core", "recorder", "server", "adapter", "probe", "imageio"}, {""}}},
        {"python", {{"core", "recorder", "query", "server", "client", "analysis"}, {"pybind11/"}}},
        {"examples", {{"core", "recorder", "server", "client", "probe", "analysis", "explorer", "emca.h"}, {"Q", "math.h", "stdio.h", "stdlib.h"}}},
    };
    return table;
}

bool isTest(const fs::path& file) {
    const std::string path = file.generic_string();
    return path.find("_test.") != std::string::npos || path.find("/testing/") != std::string::npos ||
           path.find("_for_tests") != std::string::npos || path.find("test_main") != std::string::npos ||
           path.find("_bench.") != std::string::npos;
}

bool isSource(const fs::path& file) { return file.extension() == ".h" || file.extension() == ".cpp" || file.extension() == ".c"; }

std::vector<std::pair<bool, std::string>> includesOf(const fs::path& file) {
    static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
    std::vector<std::pair<bool, std::string>> includes;
    std::ifstream in(file);
    std::smatch match;
    for (std::string line; std::getline(in, line);)
        if (std::regex_search(line, match, pattern)) includes.emplace_back(match[1] == "<", match[2]);
    return includes;
}

bool isStandard(const std::string& header) {
    static const std::regex standard(R"(^[a-z_0-9]+$)");
    return std::regex_match(header, standard);
}

/// Why a file may not include a header; empty if it may.
std::string complaint(const Rule& rule, bool angled, const std::string& header) {
    if (header.rfind("emca/", 0) == 0) {
        const std::string part = header.substr(5, header.find('/', 5) - 5);
        return rule.parts.contains(part) ? "" : "may not know " + part;
    }
    if (!angled) return header.rfind("vtk", 0) == 0 ? "uses VTK" : "";  // its own folder
    if (isStandard(header)) return "";
    for (const std::string& prefix : rule.others)
        if (header.rfind(prefix, 0) == 0) return "";
    return "may not use <" + header + ">";
}

TEST(Architecture, IncludesFollowTheArrows) {
    const fs::path root = EMCA_SOURCE_DIR;
    int files = 0;
    for (const auto& [folder, rule] : rules()) {
        if (!fs::exists(root / folder)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            if (!isSource(entry.path()) || isTest(entry.path())) continue;
            ++files;
            for (const auto& [angled, header] : includesOf(entry.path())) {
                const std::string why = complaint(rule, angled, header);
                EXPECT_TRUE(why.empty()) << fs::relative(entry.path(), root) << " " << why;
            }
        }
    }
    EXPECT_GT(files, 20);
}

TEST(Architecture, ARendererThatLinksTheServerSeesTheStandardLibraryOnly) {
    const fs::path root = EMCA_SOURCE_DIR;
    for (const char* folder : {"libs/core/include", "libs/recorder/include", "libs/server/include", "libs/client/include"})
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            if (!isSource(entry.path())) continue;
            for (const auto& [angled, header] : includesOf(entry.path()))
                EXPECT_TRUE(angled ? isStandard(header) : header.rfind("emca/", 0) == 0) << fs::relative(entry.path(), root) << ": " << header;
        }
}

/// And one in C sees C.
TEST(Architecture, TheHeadersOfCKnowNothingOfCpp) {
    const fs::path root = EMCA_SOURCE_DIR;
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root / "libs/c/include")) {
        if (!isSource(entry.path())) continue;
        ++files;
        for (const auto& [angled, header] : includesOf(entry.path()))
            EXPECT_TRUE(angled ? header == "stdbool.h" || header == "stddef.h" || header == "stdint.h" : header.rfind("emca/c/", 0) == 0)
                << fs::relative(entry.path(), root) << ": " << header;
    }
    EXPECT_GT(files, 5);
}

/// The explorer's own plugins get what anybody's plugin gets.
TEST(Architecture, PluginsSeeThePublicInterfaceOnly) {
    const fs::path root = EMCA_SOURCE_DIR;
    for (const char* folder : {"plugins", "apps/explorer/include"}) {
        if (!fs::exists(root / folder)) GTEST_SKIP() << "There is no " << folder << ".";
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            if (!isSource(entry.path()) || isTest(entry.path())) continue;
            for (const auto& [angled, header] : includesOf(entry.path())) {
                const bool own = header.find('/') == std::string::npos;   // beside it
                EXPECT_TRUE(angled || own || header.rfind("emca/", 0) == 0) << fs::relative(entry.path(), root) << ": " << header;
            }
        }
    }
}

TEST(Architecture, VtkStaysInItsFolder) {
    const fs::path root = EMCA_SOURCE_DIR;
    const fs::path explorer = root / "apps/explorer";
    if (!fs::exists(explorer)) GTEST_SKIP() << "The explorer is not there.";
    for (const auto& entry : fs::recursive_directory_iterator(explorer)) {
        if (!isSource(entry.path()) || entry.path().generic_string().find("/explorer/scene/") != std::string::npos) continue;
        for (const auto& [angled, header] : includesOf(entry.path()))
            EXPECT_FALSE(header.rfind("vtk", 0) == 0 || header.rfind("QVTK", 0) == 0) << fs::relative(entry.path(), root) << ": " << header;
    }
}

/// Programs load OpenImageIO and what hangs on it only when they need it.
TEST(Architecture, OpenImageIoStaysInItsModule) {
    const fs::path root = EMCA_SOURCE_DIR;
    for (const auto& entry : fs::recursive_directory_iterator(root / "libs/imageio")) {
        if (!isSource(entry.path()) || isTest(entry.path()) || entry.path().filename() == "oiio_module.cpp") continue;
        for (const auto& [angled, header] : includesOf(entry.path()))
            EXPECT_NE(header.rfind("OpenImageIO/", 0), 0u) << fs::relative(entry.path(), root) << ": " << header;
    }
}

TEST(Architecture, ADoubtfulIncludeIsFound) {
    EXPECT_NE(complaint(rules().at("libs/core"), false, "emca/server/server.h"), "");
    EXPECT_NE(complaint(rules().at("libs/client"), false, "emca/server/server.h"), "");
    EXPECT_NE(complaint(rules().at("libs/analysis"), true, "QWidget"), "");
    EXPECT_NE(complaint(rules().at("python"), false, "emca/render/scene.h"), "");
    EXPECT_EQ(complaint(rules().at("libs/server"), true, "vector"), "");
}

}  // namespace
