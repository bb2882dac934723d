#include "surface_panel.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QRadioButton>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>

#include "surface_test_data.h"

// The panel with real events; the pictures are tested in scene_surface_test.cpp.
namespace emca::explorer::testing {
namespace {

struct SurfacePanelTest : ::testing::Test {
    SurfacePanelTest() {
        panel.resize(320, 700);
        panel.show();
    }
    template <typename Widget>
    Widget& find(const QString& name) {
        Widget* found = nullptr;   // lists that were replaced wait for their deletion, hidden
        for (Widget* widget : panel.findChildren<Widget*>(name))
            if (!found || widget->isVisible()) found = widget;
        if (!found) throw std::runtime_error("no widget " + name.toStdString());
        return *found;
    }
    void click(QAbstractButton& button) { QTest::mouseClick(&button, Qt::LeftButton, {}, {8, button.height() / 2}); }
    void type(const QString& field, const QString& text) {
        auto& edit = find<QLineEdit>(field);
        edit.setFocus();
        edit.selectAll();
        QTest::keyClick(&edit, Qt::Key_Delete);
        QTest::keyClicks(&edit, text);
        QTest::keyClick(&edit, Qt::Key_Return);
    }
    void offer(std::vector<std::string> names) {
        client::ServerInfo info;
        info.renderer = "test";
        for (const std::string& name : names) info.layers.push_back({name, LayerKind::mean, "", "a test"});
        dataset.setInfo(info);
    }
    Theme theme;
    client::Dataset dataset;
    SurfaceModel model{dataset, theme};
    SurfacePanel panel{dataset, model, theme};
};

TEST_F(SurfacePanelTest, SaysWhatToDoUntilThereIsSomething) {
    auto& hint = find<QLabel>("layerHint");
    EXPECT_TRUE(hint.text().contains("Connect"));
    offer({});
    EXPECT_TRUE(hint.text().contains("collects no data on surfaces"));
    EXPECT_FALSE(find<QPushButton>("renderLayers").isVisible());
    offer({"depth", "hits"});
    EXPECT_TRUE(hint.text().contains("Tick layers"));
    EXPECT_TRUE(find<QPushButton>("renderLayers").isVisible());
    fillWall(dataset);
    EXPECT_FALSE(hint.isVisible());
}

TEST_F(SurfacePanelTest, TickedLayersAreCollected) {
    offer({"depth", "hits"});
    panel.setCanRender(true);
    auto& button = find<QPushButton>("renderLayers");
    EXPECT_FALSE(button.isEnabled());
    QSignalSpy wanted(&panel, &SurfacePanel::renderWanted);
    click(find<QCheckBox>("collect:hits"));
    EXPECT_EQ(panel.wantedLayers(), std::vector<std::string>{"hits"});
    EXPECT_EQ(button.text(), "Render with 1 layer");
    click(button);
    EXPECT_EQ(wanted.count(), 1);
    click(find<QCheckBox>("collect:hits"));
    EXPECT_TRUE(panel.wantedLayers().empty());
    panel.setWantedLayers({"all"});
    EXPECT_EQ(panel.wantedLayers(), (std::vector<std::string>{"depth", "hits"}));
    offer({"hits"});
    EXPECT_EQ(panel.wantedLayers(), std::vector<std::string>{"hits"}) << "another renderer offers less";
}

TEST_F(SurfacePanelTest, OneLayerAtATimeOrNone) {
    fillWall(dataset);
    click(find<QRadioButton>("show:hits"));
    EXPECT_EQ(model.shown()->description.name, "hits");
    click(find<QRadioButton>("show:"));
    EXPECT_FALSE(model.shown());
    click(find<QRadioButton>("show:albedo"));
    EXPECT_TRUE(model.isColor());
    EXPECT_FALSE(find<QComboBox>("layerMap").isVisible());
    EXPECT_TRUE(find<QSlider>("layerExposure").isVisible());
    find<QDoubleSpinBox>("layerExposureValue").setValue(2);
    EXPECT_EQ(model.style().exposure, 2.f);
    click(find<QRadioButton>("show:depth"));
    EXPECT_TRUE(find<QComboBox>("layerMap").isVisible());
    QTest::keyClick(&find<QComboBox>("layerMap"), Qt::Key_Down);
    EXPECT_EQ(model.style().map, analysis::ColorMapId::plasma);
}

TEST_F(SurfacePanelTest, LogAndPercentilesChangeTheRange) {
    fillWall(dataset);
    click(find<QRadioButton>("show:hits"));
    click(find<QCheckBox>("layerLog"));
    EXPECT_TRUE(model.range().log);
    EXPECT_TRUE(model.style().of("hits").log);
    EXPECT_FALSE(model.style().of("depth").log);
    const double before = model.range().max;
    find<QDoubleSpinBox>("percentUpper").setValue(51);
    EXPECT_EQ(model.style().upper, 0.51);
    EXPECT_LE(model.range().max, before);
    click(find<QCheckBox>("layerLog"));
    EXPECT_FALSE(model.range().log);
}

TEST_F(SurfacePanelTest, ARangeByHandIsCheckedBeforeItIsTaken) {
    fillWall(dataset);
    click(find<QRadioButton>("show:depth"));
    type("rangeMinimum", "0.5");
    type("rangeMaximum", "8");
    EXPECT_EQ(model.range(), (analysis::ValueRange{0.5, 8, false}));
    auto& complaint = find<QLabel>("rangeComplaint");
    EXPECT_FALSE(complaint.isVisible());
    for (const char* bad : {"abc", "", "nan", "inf", "1e999", "9"}) {
        type("rangeMinimum", bad);
        EXPECT_EQ(model.range(), (analysis::ValueRange{0.5, 8, false})) << bad;
        EXPECT_EQ(find<QLineEdit>("rangeMinimum").text(), "0.5000") << bad;
        EXPECT_TRUE(complaint.isVisible()) << bad;
    }
    click(find<QCheckBox>("layerLog"));
    EXPECT_FALSE(complaint.isVisible());
    type("rangeMinimum", "0");
    EXPECT_TRUE(complaint.text().contains("above 0"));
    EXPECT_EQ(model.range(), (analysis::ValueRange{0.5, 8, true}));
    click(find<QPushButton>("rangeReset"));
    EXPECT_FALSE(model.isRangeByHand());
    EXPECT_FALSE(complaint.isVisible());
    EXPECT_NE(model.range().max, 8);
}

TEST_F(SurfacePanelTest, AnExhaustedBudgetIsSaid) {
    fillWall(dataset);
    auto& words = find<QLabel>("coarseWords");
    EXPECT_FALSE(words.isVisible());
    auto field = std::make_shared<SurfaceField>(*wallField());
    field->counts.coarse = 21;
    dataset.setSurface(field);
    EXPECT_TRUE(words.isVisible());
    EXPECT_TRUE(words.text().contains("21 of 42 places (50.00 %)")) << words.text().toStdString();
}

}  // namespace
}  // namespace emca::explorer::testing
