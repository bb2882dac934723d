// What README.md and docs/ tell a person to type works, and what they show compiles.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <sstream>

#include "process.h"

namespace emca {
namespace {

namespace fs = std::filesystem;
using test::run;

const fs::path kSource = EMCA_SOURCE_DIR;
const fs::path kWork = EMCA_WORK_DIR;

std::string contents(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

std::vector<fs::path> pages() {
    std::vector<fs::path> found{kSource / "README.md"};
    for (const auto& entry : fs::recursive_directory_iterator(kSource / "docs"))
        if (entry.path().extension() == ".md") found.push_back(entry.path());
    std::sort(found.begin() + 1, found.end());
    return found;
}

/// The fenced blocks of one language, in order.
std::vector<std::string> blocks(const fs::path& page, const std::string& language) {
    std::vector<std::string> found;
    std::istringstream text(contents(page));
    bool inside = false;
    for (std::string line; std::getline(text, line);) {
        if (!inside && line == "```" + language) {
            inside = true;
            found.emplace_back();
        } else if (inside && line == "```") {
            inside = false;
        } else if (inside) {
            found.back() += line + "\n";
        }
    }
    return found;
}

std::vector<std::string> commands(const fs::path& page) {
    std::vector<std::string> found;
    for (const std::string& block : blocks(page, "console")) {
        std::istringstream text(block);
        for (std::string line; std::getline(text, line);)
            if (line.rfind("$ ", 0) == 0) found.push_back(line.substr(2));
    }
    return found;
}

/// Runs the commands of one page one after the other, as a person would in one terminal.
class Terminal {
  public:
    explicit Terminal(const fs::path& page) : folder_(kWork / (page.parent_path().stem().string() + "-" + page.stem().string())) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
        fs::create_directory_symlink(kSource / "scenes", folder_ / "scenes");
        fs::create_directory_symlink(kSource / "scripts", folder_ / "scripts");
    }

    void type(std::string command) {
        SCOPED_TRACE(command);
        command = std::regex_replace(command, std::regex(R"(build/release/bin/)"), "");
        if (std::smatch match; std::regex_search(command, match, std::regex(R"(^emca-render .*--serve (\S+))"))) return serve(match[1], command);
        if (server_) command = std::regex_replace(command, std::regex(R"((localhost|127\.0\.0\.1):50013)"), server_->address());
        if (command.rfind("emca ", 0) == 0 || command.rfind("emca-render ", 0) == 0) return succeed(command);
        if (command.rfind("emca-explorer ", 0) == 0) return;  // a window: tests/explorer drives it
        if (command.rfind("scripts/", 0) == 0) return succeed("bash -n " + command.substr(0, command.find(' ')));
        if (std::smatch match; std::regex_search(command, match, std::regex(R"(^(cmake|cmake --build|ctest) --preset (\S+)$)"))) {
            EXPECT_NE(contents(kSource / "CMakePresets.json").find("\"name\": \"" + match[2].str() + "\""), std::string::npos);
            return;
        }
        if (std::smatch match; std::regex_search(command, match, std::regex(R"(^cmake .*-D(EMCA_[A-Z0-9_]+)=)"))) return knowOptions(command);
        if (std::smatch match; std::regex_search(command, match, std::regex(R"(^cmake --build build/\S+( --target (\S+))?$)"))) return knowTarget(match[2]);
        if (std::smatch match; std::regex_search(command, match, std::regex(R"(^(?:\S*/)?(emca-(?:bridge|pbrt|lajolla|nori)|mitsuba)\b)"))) return knowAdapter(match[1], command);
        if (command.rfind("cmake --install ", 0) == 0) return;  // tests/consumer installs and uses it
        // python/tests install the package, and serve and read back this example.
        if (command.rfind("python3 -m venv ", 0) == 0 || command.find("/bin/pip install ") != std::string::npos) return;
        if (command.rfind("python3 examples/", 0) == 0) {
            const std::string file = command.substr(8, command.find(' ', 8) - 8);
            EXPECT_TRUE(fs::exists(kSource / file)) << file;
            return;
        }
        ADD_FAILURE() << "This test does not know how to try that command: teach it.";
    }

  private:
    /// Adapters need renderers that this machine may not have: their options are at least those of the source.
    static std::string buildFiles() {
        std::string known;
        for (const auto& entry : fs::recursive_directory_iterator(kSource / "integrations"))
            if (entry.path().extension() == ".txt" || entry.path().extension() == ".cmake") known += contents(entry.path());
        return known;
    }

    static void knowTarget(const std::string& target) { EXPECT_NE(buildFiles().find(target), std::string::npos) << target; }

    static void knowOptions(const std::string& command) {
        const std::string known = buildFiles();
        const std::regex option(R"(-D(EMCA_[A-Z0-9_]+)=)");
        for (std::sregex_iterator it(command.begin(), command.end(), option), end; it != end; ++it)
            EXPECT_NE(known.find((*it)[1].str()), std::string::npos) << (*it)[1];
    }

    static void knowAdapter(const std::string& program, const std::string& command) {
        const std::map<std::string, std::string> folders{{"emca-bridge", "emca2021"}, {"emca-pbrt", "pbrt4"}, {"emca-lajolla", "lajolla"}, {"emca-nori", "nori"}, {"mitsuba", "mitsuba06"}};
        const fs::path folder = kSource / "integrations" / folders.at(program);
        ASSERT_TRUE(fs::exists(folder / "CMakeLists.txt"));
        if (program == "mitsuba") return;  // its options are Mitsuba's
        std::string known;
        for (const fs::path& part : {folder, kSource / "integrations/program", kSource / "libs/adapter"})
            for (const auto& entry : fs::recursive_directory_iterator(part))
                if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h") known += contents(entry.path());
        const std::regex option(R"(\s(--[a-z-]+))");
        for (std::sregex_iterator it(command.begin(), command.end(), option), end; it != end; ++it)
            EXPECT_NE(known.find((*it)[1].str()), std::string::npos) << (*it)[1];
    }

    void serve(const std::string& where, std::string command) {
        command = std::regex_replace(command, std::regex(R"(\s*&$)"), "");
        command.replace(command.find("--serve " + where), 8 + where.size(), "--serve 0 --size 320x240");
        server_ = std::make_unique<test::ServingProcess>(shell("exec " + command));
        EXPECT_FALSE(server_->address().empty());
    }

    void succeed(const std::string& command) {
        const test::Outcome outcome = run(shell(command));
        EXPECT_EQ(outcome.exitCode, 0) << outcome.out << outcome.err;
    }

    std::vector<std::string> shell(const std::string& command) const {
        return {"bash", "-c", "cd '" + folder_.string() + "' && export PATH='" EMCA_BIN "':$PATH && " + command};
    }

    fs::path folder_;
    std::unique_ptr<test::ServingProcess> server_;
};

TEST(Docs, EveryCommandWorks) {
    std::size_t count = 0;
    for (const fs::path& page : pages()) {
        SCOPED_TRACE(page.filename().string());
        Terminal terminal(page);
        for (const std::string& command : commands(page)) {
            terminal.type(command);
            ++count;
        }
    }
    EXPECT_GT(count, 10u);
}

TEST(Docs, EverySnippetCompiles) {
    std::ostringstream all;
    all << "#include \"prelude.h\"\n";
    std::size_t count = 0;
    for (const fs::path& page : pages())
        for (const std::string& block : blocks(page, "cpp")) {
            all << "\nnamespace snippet" << count++ << " { // " << page.filename().string() << "\n";
            const bool declares = std::regex_search(block, std::regex(R"(^(class|struct|template|#include|int main))"));
            all << (declares ? block : "[[maybe_unused]] void snippet() {\n" + block + "}\n") << "}\n";
        }
    EXPECT_GT(count, 3u);
    fs::create_directories(kWork);
    const fs::path file = kWork / "snippets.cpp";
    std::ofstream(file) << all.str();
    const auto include = [](const char* part) { return "-I" + (kSource / "libs" / part / "include").string(); };
    const test::Outcome outcome = run({EMCA_COMPILER, "-std=c++20", "-fsyntax-only", "-I" + (kSource / "tests/docs").string(), include("core"),
                                       include("recorder"), include("server"), include("client"), include("probe"), include("adapter"), file.string()});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
}

TEST(Docs, LinksLeadSomewhere) {
    const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
    for (const fs::path& page : pages()) {
        const std::string text = contents(page);
        for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it)
            EXPECT_TRUE(fs::exists(page.parent_path() / (*it)[1].str())) << page.filename() << " links to " << (*it)[1];
    }
}

}  // namespace
}  // namespace emca
