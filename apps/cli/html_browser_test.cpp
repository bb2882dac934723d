// Pages of `emca export` in a browser: they load, turn, and select, without complaint and without network.
#include "chromium_for_tests.h"
#include "emca/analysis/format.h"
#include "export_for_tests.h"

namespace emca::cli {
namespace {

class Browser : public ProgramTest {
  protected:
    void SetUp() override {
        if (Chromium::program().empty())
            GTEST_SKIP() << "left out: pages are tested in Chromium, which is not installed (scripts/install-deps.sh installs it)";
        served.start();
        served.renderer.scene = {hostileWall()};
        served.renderer.description.scene = "<b>hash</b>";
        json({"export", served.address().text(), "5", "6", "--spp", "64", "--html", "a.html", "--json"});
    }
    std::string url() const { return "file://" + program.file("a.html").string(); }
    /// Where an element is: {"x", "y", "width", "height"}.
    static Json placeOf(Chromium& browser, const std::string& selector) {
        return browser.evaluate("(() => { const r = document.querySelector('" + selector + "').getBoundingClientRect(); return {x: r.x, y: r.y, width: r.width, height: r.height}; })()");
    }
    static void clickOn(Chromium& browser, const std::string& selector) {
        const Json place = placeOf(browser, selector);
        browser.click(place["x"].get<double>() + place["width"].get<double>() / 2, place["y"].get<double>() + place["height"].get<double>() / 2);
        browser.settle();
    }
    static std::string pictureOf(Chromium& browser, const std::string& selector) { return browser.picture(placeOf(browser, selector)); }
    /// How many colours a canvas of WebGL shows, in steps of 16.
    static int coloursOf(Chromium& browser, const std::string& id) {
        const std::string code = "new Promise((done) => { emca.scene.draw(); const from = document.getElementById('" + id + "'), to = document.createElement('canvas');"
            "to.width = from.width; to.height = from.height; const c = to.getContext('2d'); c.drawImage(from, 0, 0);"
            "const d = c.getImageData(0, 0, to.width, to.height).data, seen = new Set();"
            "for (let i = 0; i < d.length; i += 4) seen.add((d[i] >> 4) << 8 | (d[i + 1] >> 4) << 4 | d[i + 2] >> 4); done(seen.size); })";
        return browser.evaluate(code).get<int>();
    }
    static void expectQuiet(const Chromium& browser, const std::string& page) {
        EXPECT_TRUE(browser.complaints.empty()) << testing::PrintToString(browser.complaints);
        for (const std::string& request : browser.requests) EXPECT_TRUE(request == page || request == "data:,") << request;
        EXPECT_FALSE(browser.requests.empty());
    }
    test::Served served;
};

TEST_F(Browser, APageOpensTurnsAndSelects) {
    Chromium browser;
    browser.open(url());
    browser.until("emca.scene.drawn === true");
    EXPECT_EQ(browser.evaluate("document.body.dataset.attacked === undefined"), true);
    EXPECT_EQ(browser.evaluate("document.getElementById('scene-word').hidden"), true);
    EXPECT_GT(coloursOf(browser, "scene"), 12);
    RecordProperty("firstFrameMilliseconds", browser.evaluate("Math.round(emca.scene.firstFrame)").dump());

    // Turning, by mouse and by keys; C goes back.
    browser.evaluate("emca.scene.focus()");
    browser.until("emca.scene.camera.easing === null");
    browser.settle();
    const Json scene = placeOf(browser, "#scene");
    const double x = scene["x"].get<double>() + scene["width"].get<double>() / 2, y = scene["y"].get<double>() + 90;
    const std::string before = pictureOf(browser, "#scene");
    browser.mouse("mousePressed", x, y, 1);
    for (int i = 1; i <= 6; ++i) browser.mouse("mouseMoved", x + 20 * i, y + 6 * i, 1);
    browser.mouse("mouseReleased", x + 120, y + 36);
    browser.settle();
    const std::string turned = pictureOf(browser, "#scene");
    EXPECT_NE(turned, before);
    browser.key("ArrowLeft");
    browser.settle();
    EXPECT_NE(pictureOf(browser, "#scene"), turned);
    browser.key("c");
    browser.until("emca.scene.camera.easing === null");
    EXPECT_EQ(browser.evaluate("emca.scene.camera.pose === emca.scene.camera.home"), true);

    // A row of the table selects in all views.
    EXPECT_EQ(browser.evaluate("emca.selection.path === emca.data.analysis.order[0]"), true);
    const std::string sceneOfFirst = pictureOf(browser, "#scene"), plotOfFirst = pictureOf(browser, "#plot-luminance");
    clickOn(browser, ".line-row:nth-child(4)");
    EXPECT_EQ(browser.evaluate("emca.selection.path === emca.data.analysis.order[3]"), true);
    EXPECT_EQ(browser.evaluate("document.querySelectorAll('#table [aria-selected=true]').length"), 1);
    EXPECT_EQ(browser.evaluate("document.getElementById('path-title').textContent === 'Path ' + emca.data.pixel.paths[emca.selection.path].sample"), true);
    EXPECT_EQ(browser.evaluate("document.querySelectorAll('#vertices [data-vertex]').length"), 4);  // the path and its three
    browser.mouse("mouseMoved", 5, 5);
    browser.settle();
    EXPECT_NE(pictureOf(browser, "#scene"), sceneOfFirst);
    EXPECT_NE(pictureOf(browser, "#plot-luminance"), plotOfFirst);

    // A vertex: from the list, by key, and its values.
    clickOn(browser, "#vertices [data-vertex=\"1\"]");
    EXPECT_EQ(browser.evaluate("emca.selection.vertex"), 1);
    EXPECT_EQ(browser.evaluate("document.getElementById('values').textContent.includes('vertex 2')"), true);
    browser.key(".");
    EXPECT_EQ(browser.evaluate("emca.selection.vertex"), 2);
    EXPECT_EQ(browser.evaluate("document.getElementById('values-title').textContent.startsWith('Vertex 3')"), true);
    browser.key("Escape");
    EXPECT_EQ(browser.evaluate("emca.selection.path"), -1);

    // A vertex on the screen leads to its path.
    browser.evaluate("emca.selection.select(emca.data.analysis.order[0], 0); emca.scene.focus()");
    browser.until("emca.scene.camera.easing === null");
    browser.settle();
    const Json at = browser.evaluate("emca.scene.project(emca.scene.data.paths[emca.selection.path].points[2])");
    browser.click(scene["x"].get<double>() + at[0].get<double>(), scene["y"].get<double>() + at[1].get<double>());
    EXPECT_EQ(browser.evaluate("emca.selection.vertex"), 2);
    expectQuiet(browser, url());
}

TEST_F(Browser, NumbersReadAsEverywhere) {
    Chromium browser;
    browser.open(url());
    Json values = Json::array(), expected = Json::array();
    std::vector<double> numbers{0, 1, -1, 1234.5, 1235.5, -1234.5, 0.5, 9999.5, 9999.4, 99995, 1e-4, 9.9999e-5, 12345678, 1e300, 5e-324, -0.00012345, 1.0005, 2.0015, 100};
    for (double v = 1.23456789e-9; v < 1e12; v *= 3.7) numbers.push_back(v);
    for (const double v : numbers) {
        values.push_back(v);
        expected.push_back(analysis::formatNumber(v));
    }
    EXPECT_EQ(browser.evaluate(values.dump() + ".map(emca.formatNumber)"), expected);
    EXPECT_EQ(browser.evaluate("[NaN, Infinity, -Infinity, -0].map(emca.formatNumber)").dump(), R"(["NaN","Infinity","-Infinity","-0"])");
    EXPECT_TRUE(browser.evaluate("emca.data.pixel") == pageData(pageText(program.file("a.html")))["pixel"]);
    expectQuiet(browser, url());
}

TEST_F(Browser, WithoutGraphicsTheRestWorks) {
    Chromium browser({"--disable-3d-apis"});
    browser.open(url());
    EXPECT_EQ(browser.evaluate("document.getElementById('scene-word').textContent.includes('WebGL')"), true);
    EXPECT_EQ(browser.evaluate("document.getElementById('scene-word').hidden"), false);
    clickOn(browser, ".line-row:nth-child(2)");
    EXPECT_EQ(browser.evaluate("emca.selection.path === emca.data.analysis.order[1]"), true);
    EXPECT_EQ(browser.evaluate("document.querySelectorAll('#values tr').length > 3"), true);
    browser.key("f");
    browser.key("c");
    for (const std::string& complaint : browser.complaints) EXPECT_EQ(complaint.find("exception"), std::string::npos) << complaint;
}

}  // namespace
}  // namespace emca::cli
