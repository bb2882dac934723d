#include "html_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "html_data.h"
#include "html_scene.h"
#include "mesh_budget.h"
#include "path_json.h"
#include "trace_for_tests.h"

namespace emca::cli {
namespace {

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin);
    if (from == std::string::npos) return {};
    return text.substr(from + begin.size(), text.find(end, from) - from - begin.size());
}

Json dataOf(const std::string& page) {
    return Json::parse(between(page, "<script type=\"application/json\" id=\"emca-data\">", "</script>"), nullptr, false);
}

std::size_t count(const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
    return found;
}

std::vector<std::byte> bytesOf(const std::string& text) {
    const auto* data = reinterpret_cast<const std::byte*>(text.data());
    return {data, data + text.size()};
}

/// A square of n x n x 2 triangles in the plane z = height.
Mesh grid(std::uint32_t n, float height) {
    Mesh mesh;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x)
            mesh.positions.push_back({static_cast<float>(x) / static_cast<float>(n), static_cast<float>(y) / static_cast<float>(n), height});
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + n + 1;
            mesh.triangles.push_back({a, a + 1, b});
            mesh.triangles.push_back({a + 1, b + 1, b});
        }
    return mesh;
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum += static_cast<double>(length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]))) / 2;
    return sum;
}

TEST(HtmlPage, Base64EqualsItsSpecification) {
    // RFC 4648, section 10.
    EXPECT_EQ(toBase64(bytesOf("")), "");
    EXPECT_EQ(toBase64(bytesOf("f")), "Zg==");
    EXPECT_EQ(toBase64(bytesOf("fo")), "Zm8=");
    EXPECT_EQ(toBase64(bytesOf("foo")), "Zm9v");
    EXPECT_EQ(toBase64(bytesOf("foobar")), "Zm9vYmFy");
    EXPECT_EQ(toBase64(bytesOf("\xff\xfe\xfd")), "//79");
}

TEST(HtmlPage, NothingInDataEndsItsElement) {
    const std::string hostile = "</script><script>alert(1)</script><!--<script>\x01\x1b\n\"'&{{data}}{{script}}\xff";
    Json data;
    data["title"] = hostile;
    data[hostile] = 1;
    const std::string page = htmlPage(hostile, data), harmless = htmlPage("a", Json{{"title", "b"}});
    for (const char* tag : {"<script", "</script", "<!--", "</title", "</style"}) EXPECT_EQ(count(page, tag), count(harmless, tag)) << tag;
    const std::string title = between(page, "<title>", "</title>");
    EXPECT_EQ(title.find_first_of(std::string("<>\"'\x01\x1b\n")), std::string::npos) << title;
    const Json back = dataOf(page);
    ASSERT_TRUE(back.is_object());
    EXPECT_EQ(back["title"], hostile.substr(0, hostile.size() - 1) + "\uFFFD");  // what is no UTF-8 cannot be JSON
}

TEST(HtmlPage, LoadsNothing) {
    const std::string page = htmlPage("a", Json::object());
    for (const char* word : {"http://", "https://", "//cdn", "src=", "@import", "url(", "fetch(", "XMLHttpRequest", "eval("})
        EXPECT_EQ(page.find(word), std::string::npos) << word;
    EXPECT_NE(page.find("default-src &#39;none&#39;"), std::string::npos);
    EXPECT_EQ(page.find("unsafe-inline"), std::string::npos);
    EXPECT_EQ(page.find("\nimport "), std::string::npos);
    EXPECT_EQ(page.find("\nexport "), std::string::npos);
}

TEST(HtmlData, ValuesAreThoseOfThePixelCommand) {
    PageContent content;
    content.title = "a";
    content.trace = exampleTrace();
    const Json data = dataOf(htmlPage(content.title, pageJson(content)));
    EXPECT_EQ(data["pixel"].dump(), pixelJson(content.trace).dump());
    EXPECT_EQ(data["analysis"]["paths"], 2);
    EXPECT_EQ(data["analysis"]["luminance"]["values"][0], "NaN");
    EXPECT_TRUE(data["analysis"]["luminance"]["values"][1].is_null());
    EXPECT_EQ(data["analysis"]["segments"][0].dump(), "[[-1,0,0],[0,2,2]]");
    EXPECT_TRUE(data["scene"].is_null());
}

TEST(HtmlData, TheBrightestPathsStay) {
    PageContent content;
    content.trace = exampleTrace();
    content.maximumPaths = 1;
    const Json data = pageJson(content);
    ASSERT_EQ(data["pixel"]["paths"].size(), 1u);
    EXPECT_EQ(data["pixel"]["paths"][0]["sample"], 5);  // NaN: what one looks for
    EXPECT_EQ(data["analysis"]["shown"], 1);
    EXPECT_EQ(data["analysis"]["paths"], 2);
    EXPECT_EQ(data["analysis"]["outliers"]["paths"].dump(), "[0]");
}

TEST(HtmlScene, PositionsAreFractionsOfTheBox) {
    Mesh mesh;
    mesh.positions = {{-1, 2, 5}, {3, 2, 5}, {-1, 10, 5}, {1, 6, 5}};
    mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
    const Json json = sceneJson({mesh}, 100)["meshes"][0];
    EXPECT_EQ(json["min"].dump(), "[-1.0,2.0,5.0]");
    EXPECT_EQ(json["extent"].dump(), "[4.0,8.0,0.0]");
    const auto words = [](std::vector<int> values) {
        std::string bytes;
        for (const int v : values) bytes += {static_cast<char>(v & 255), static_cast<char>(v >> 8 & 255)};
        return bytes;
    };
    // In the order in which triangles name them.
    EXPECT_EQ(json["positions"], toBase64(bytesOf(words({0, 0, 0, 65535, 0, 0, 0, 65535, 0, 32768, 32768, 0}))));
    EXPECT_EQ(json["indices"], toBase64(bytesOf(words({0, 1, 2, 1, 3, 2}))));
}

TEST(MeshBudget, SmallScenesStayAsTheyAre) {
    const std::vector<Mesh> meshes{grid(8, 0), grid(4, 1)};
    const ReducedMeshes reduced = reduceMeshes(meshes, 160);
    EXPECT_FALSE(reduced.reduced());
    EXPECT_EQ(reduced.triangles, 160u);
    EXPECT_EQ(reduced.meshes[0].triangles.size(), 128u);
    EXPECT_NEAR(area(reduced.meshes[0]), 1, 1e-5);
}

TEST(MeshBudget, LargeScenesFitAndKeepTheirShape) {
    const ReducedMeshes reduced = reduceMeshes({grid(64, 0), grid(64, 1)}, 2000);
    EXPECT_EQ(reduced.before, 16384u);
    EXPECT_LE(reduced.triangles, 2000u);
    EXPECT_GT(reduced.triangles, 500u);
    for (const Mesh& mesh : reduced.meshes) {
        EXPECT_TRUE(validate(mesh).ok());
        EXPECT_NEAR(area(mesh), 1, 0.2);
    }
}

TEST(MeshBudget, AnythingFits) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-1e3f, 1e3f);
    std::vector<Mesh> meshes;
    for (int i = 0; i < 40; ++i) {
        meshes.push_back(grid(1 + static_cast<std::uint32_t>(i) % 5, uniform(random)));
        for (Vec3f& p : meshes.back().positions) p = p + Vec3f{uniform(random), uniform(random), uniform(random)};
    }
    meshes[3].positions[1].x = std::nanf("");
    meshes[4].positions[0].y = INFINITY;
    for (const std::uint64_t budget : {0u, 1u, 7u, 100u, 600u}) {
        const ReducedMeshes reduced = reduceMeshes(meshes, budget);
        EXPECT_LE(reduced.triangles, budget);
        ASSERT_EQ(reduced.meshes.size(), meshes.size());
        std::uint64_t found = 0;
        for (const Mesh& mesh : reduced.meshes) {
            EXPECT_TRUE(validate(mesh).ok());
            for (const Vec3f p : mesh.positions) EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
            found += mesh.triangles.size();
        }
        EXPECT_EQ(found, reduced.triangles);
    }
}

}  // namespace
}  // namespace emca::cli
