// docs/c-api.md and examples/languages: the same renderer in three languages, compiled, served and replayed; and every
// piece of C on the page.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "emca/client/connection.h"
#include "emca/core/seed_map.h"
#include "process.h"

namespace emca::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = EMCA_SOURCE_DIR, kWork = EMCA_WORK_DIR;
const fs::path kPage = kSource / "docs/c-api.md";

std::string contents(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// The fenced blocks of one language, in order.
std::vector<std::string> blocks(const std::string& language) {
    std::vector<std::string> found;
    std::istringstream text(contents(kPage));
    bool inside = false;
    for (std::string line; std::getline(text, line);) {
        if (!inside && line == "```" + language)
            inside = true, found.emplace_back();
        else if (inside && line == "```")
            inside = false;
        else if (inside)
            found.back() += line + "\n";
    }
    return found;
}

bool isProgram(const std::string& block) { return block.find("int main(") != std::string::npos; }

void compile(std::vector<std::string> command) {
    const Outcome outcome = run(command);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
}

/// Serves, renders and replays as any renderer, and records what it says on the page.
void expectServed(const fs::path& program) {
    const ServingProcess process({program});
    ASSERT_FALSE(process.address().empty());
    const auto connection = client::Connection::open({"127.0.0.1", std::uint16_t(process.port())});
    ASSERT_TRUE(connection.ok());
    ASSERT_TRUE((*connection)->render().ok());
    const auto trace = (*connection)->traceRect({0, 0, 4, 3});
    ASSERT_TRUE(trace.ok()) << trace.error().message;
    EXPECT_EQ(countReplays(trace->replays).exact, 12u);
    EXPECT_EQ(countReplays(trace->replays).sumsDiffer, 0u);
    const PathSet& paths = trace->paths;
    ASSERT_EQ(paths.pathCount(), 24u);
    const Column& column = *paths.find(Scope::vertex, "value").at(0);
    for (Index path = 0; path < paths.pathCount(); ++path) {
        const Pixel pixel = paths.pixel(path);
        const float expected = float(SeedMap(0).seed(pixel, std::uint64_t(paths.sample(path))) & 0xffff) / 65536.f;
        const Index vertex = paths.vertices(path).first;
        EXPECT_EQ(paths.estimate(path), Color(expected));
        EXPECT_EQ(std::get<float>(*paths.last(column, vertex)), expected);
        EXPECT_EQ(paths.position(vertex), (Vec3f{float(pixel.x), float(pixel.y), 0}));
    }
    EXPECT_TRUE((*connection)->quitServer().ok());
}

std::string library(const char* option) { return option + std::string(EMCA_LIBRARY_DIR); }

TEST(Languages, TheProgramInCIsServed) {
    fs::create_directories(kWork);
    int programs = 0;
    for (const std::string& block : blocks("c")) {
        if (!isProgram(block)) continue;
        ++programs;
        std::ofstream(kWork / "grey.c") << block;
        compile({EMCA_C_COMPILER, "-std=c11", "-Wall", "-pedantic", (kWork / "grey.c").string(),
                 "-I" + (kSource / "libs/c/include").string(), library("-L"), library("-Wl,-rpath,"), "-lemca", "-o",
                 (kWork / "grey_c").string()});
        if (!HasFatalFailure()) expectServed(kWork / "grey_c");
    }
    EXPECT_EQ(programs, 1);
}

TEST(Languages, ThePiecesInCCompile) {
    fs::create_directories(kWork);
    std::string text = contents(kSource / "tests/c_api/snippets_prelude.h");
    int pieces = 0;
    for (const std::string& block : blocks("c")) {
        if (isProgram(block)) continue;
        const std::string head = "emca_code snippet" + std::to_string(pieces++) + "(void)";
        text += head + ";\n" + head + " {\n" + block + "return EMCA_OK;\n}\n";
    }
    EXPECT_GE(pieces, 4);
    std::ofstream(kWork / "snippets.c") << text;
    compile({EMCA_C_COMPILER, "-std=c11", "-Wall", "-Wextra", "-pedantic", "-fsyntax-only",
             "-I" + (kSource / "libs/c/include").string(), (kWork / "snippets.c").string()});
}

TEST(Languages, TheProgramInRustIsServed) {
    if (std::strlen(EMCA_RUSTC) == 0) GTEST_SKIP() << "There is no rustc.";
    fs::create_directories(kWork);
    compile({EMCA_RUSTC, "--edition", "2021", "-O", (kSource / "examples/languages/grey.rs").string(), "-L",
             library("native="), "-C", library("link-arg=-Wl,-rpath,"), "-o", (kWork / "grey_rust").string()});
    if (!HasFatalFailure()) expectServed(kWork / "grey_rust");
}

TEST(Languages, TheProgramInFortranIsServed) {
    if (std::strlen(EMCA_GFORTRAN) == 0) GTEST_SKIP() << "There is no gfortran.";
    fs::create_directories(kWork);
    compile({EMCA_GFORTRAN, "-std=f2008", "-O2", "-J", kWork.string(),
             (kSource / "examples/languages/grey.f90").string(), library("-L"), library("-Wl,-rpath,"), "-lemca", "-o",
             (kWork / "grey_fortran").string()});
    if (!HasFatalFailure()) expectServed(kWork / "grey_fortran");
}

/// The page shows lines of the examples, which were compiled.
TEST(Languages, ThePageQuotesTheExamples) {
    for (const auto& [language, file] : {std::pair("rust", "grey.rs"), std::pair("fortran", "grey.f90")}) {
        const std::string example = contents(kSource / "examples/languages" / file);
        std::size_t lines = 0;
        for (const std::string& block : blocks(language)) {
            std::istringstream text(block);
            for (std::string line; std::getline(text, line); ++lines)
                EXPECT_NE(example.find(line + "\n"), std::string::npos) << line;
        }
        EXPECT_GT(lines, 5u) << language;
    }
}

}  // namespace
}  // namespace emca::test
