// The plugin as the explorer loads it.
#include <gtest/gtest.h>

#include <QLabel>
#include <QTemporaryDir>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>

#include "base/state_overlay.h"
#include "plots/marginal_histogram.h"
#include "plots/plot_widget.h"
#include "plots/scatter_plot.h"
#include "plots/top_histogram.h"
#include "plugin/plugin_host.h"
#include "plugin/probe_steps.h"

namespace emca::explorer {
namespace {

struct NoServices : PluginServices {
    Result<void> setObject(const std::string&, const std::string&, SceneObject) override { return {}; }
    void removeObject(const std::string&, const std::string&) override {}
    void removeObjects(const std::string&) override {}
    Subscription onPick(const std::string&, std::function<void(const std::string&, std::size_t)>) override { return {}; }
    std::shared_ptr<client::Connection> connection() override { return nullptr; }
    void say(const QString&) override {}
    void sayError(const QString&) override {}
};

class IntersectionDataTest : public testing::Test {
  protected:
    void SetUp() override {
        auto library = loadPluginLibrary(INTERSECTION_DATA_PLUGIN);
        ASSERT_TRUE(library) << library.error().message;
        host = std::make_unique<PluginHost>(std::move(*library), HostContext::Surroundings{dataset, selection, theme, services, settings});
        host->start();
        ASSERT_TRUE(host->isRunning()) << host->reason().toStdString();
        host->view()->resize(620, 420);
        host->view()->show();
        QCoreApplication::processEvents();
    }
    void selectPath(std::int64_t sample = 1) {
        dataset.addTrace(sampleTrace());
        selection.setPaths({{Pixel{1, 2}, sample, 0}});
        QCoreApplication::processEvents();
    }
    QTreeWidget& list() { return *host->view()->findChild<QTreeWidget*>("quantities"); }
    void choose(const QStringList& names) {
        list().clearSelection();
        for (const QString& name : names)
            for (QTreeWidgetItem* item : list().findItems(name, Qt::MatchExactly)) item->setSelected(true);
        QCoreApplication::processEvents();
    }
    QString valueOf(const QString& name) { return list().findItems(name, Qt::MatchExactly).front()->text(1); }
    std::vector<PlotWidget*> plots() {
        std::vector<PlotWidget*> shown;
        for (PlotWidget* plot : host->view()->findChildren<PlotWidget*>())
            if (plot->isVisible()) shown.push_back(plot);
        return shown;
    }
    client::VertexId vertex(std::int32_t depth, std::int64_t sample = 1) const { return {{Pixel{1, 2}, sample, 0}, depth, Subpath::camera}; }

    QTemporaryDir folder;
    QSettings settings{folder.filePath("settings.ini"), QSettings::IniFormat};
    client::Dataset dataset;
    client::Selection selection;
    Theme theme;
    NoServices services;
    std::unique_ptr<PluginHost> host;
};

TEST_F(IntersectionDataTest, SaysWhatToDoUntilThereIsAPath) {
    EXPECT_TRUE(host->view()->overlay().sentence().contains("pixel"));
    dataset.addTrace(sampleTrace());
    EXPECT_TRUE(host->view()->overlay().sentence().contains("path"));
    selectPath();
    EXPECT_EQ(host->view()->overlay().sentence(), "");
    EXPECT_EQ(list().topLevelItemCount(), 6);
}

TEST_F(IntersectionDataTest, EachKindHasItsPlot) {
    selectPath();
    choose({"pdf"});
    ASSERT_EQ(plots().size(), 1u);
    EXPECT_EQ(plots()[0]->csv(), "depth,pdf\n1,0.5\n2,Infinity\n3,0.699999988079071\n4,0.800000011920929\n");
    choose({"bsdf weight"});
    EXPECT_EQ(plots()[0]->plot().content().groups.size(), 3u);
    EXPECT_EQ(plots()[0]->plot().content().groups[1].color, theme.colors().green);
    choose({"material"});
    EXPECT_EQ(plots()[0]->csv(), "depth,material\n1,diffuse\n2,\n3,diffuse\n4,\n");
    choose({"random"});
    EXPECT_TRUE(plots()[0]->topHistogram().isVisible() && plots()[0]->plot().histogram()->isVisible());
    EXPECT_EQ(plots()[0]->plot().xAxis().quantity, "random x");
    choose({"pdf", "material", "tries"});
    EXPECT_EQ(plots().size(), 3u);
}

TEST_F(IntersectionDataTest, PicksSelectTheVertexAndSelectedVerticesAreMarked) {
    selectPath();
    choose({"tries"});
    ScatterPlot& plot = plots()[0]->plot();
    const auto at = [&](std::uint32_t point) { return plot.content().frame.place(plot.content().xs[point], plot.content().ys[point])->toPoint(); };
    QTest::mouseClick(plot.canvas(), Qt::LeftButton, {}, at(2));
    EXPECT_EQ(selection.state().vertex, vertex(3));
    EXPECT_EQ(plot.content().selected, (std::vector<std::uint32_t>{2}));
    EXPECT_EQ(valueOf("tries"), "6");
    selection.setVertex(vertex(1));
    EXPECT_EQ(plot.content().selected, (std::vector<std::uint32_t>{0}));
    EXPECT_EQ(valueOf("tries"), "4");
    QTest::mouseMove(plot.canvas(), at(1));
    QCoreApplication::processEvents();
    EXPECT_EQ(selection.hovered(), vertex(2));
    EXPECT_TRUE(plot.hoverText().contains("depth 2") && plot.hoverText().contains("5")) << plot.hoverText().toStdString();
}

TEST_F(IntersectionDataTest, PointsAreSeenInTheirColoursBesideTheSelectedOne) {
    selectPath();
    choose({"bsdf weight"});
    selection.setVertex(vertex(1));
    QCoreApplication::processEvents();
    ScatterPlot& plot = plots()[0]->plot();
    const QImage picture = plot.canvas()->grab().toImage();
    const ScatterContent& content = plot.content();
    for (const auto& [point, selected] : {std::pair(0u, true), std::pair(3u, false), std::pair(7u, false)}) {
        const QPointF at = *content.frame.place(content.xs[point], content.ys[point]);
        const QColor seen = picture.pixelColor((at * picture.devicePixelRatio()).toPoint()), ground = theme.colors().ground;
        const int distance = std::abs(seen.red() - ground.red()) + std::abs(seen.green() - ground.green()) + std::abs(seen.blue() - ground.blue());
        EXPECT_GT(distance, 30) << point;
        EXPECT_EQ(seen == theme.colors().selected, selected) << point;
    }
}

TEST_F(IntersectionDataTest, ChosenQuantitiesStayFromPathToPathAndForTheNextStart) {
    selectPath(0);
    choose({"tries", "random"});
    selection.setPaths({{Pixel{1, 2}, 2, 0}});
    QCoreApplication::processEvents();
    EXPECT_EQ(plots().size(), 2u);
    EXPECT_EQ(plots()[1]->csv().section('\n', 1, 1), "1,8") << "the third path begins at vertex 8";
    EXPECT_EQ(settings.value("plugins/intersection-data/chosen").toStringList(), (QStringList{"random", "tries"}));
}

TEST_F(IntersectionDataTest, WhatIsHiddenCatchesUpWhenItIsShown) {
    host->view()->hide();
    selectPath();
    EXPECT_EQ(list().topLevelItemCount(), 0);
    selection.setVertex(vertex(2));
    host->view()->show();
    QCoreApplication::processEvents();
    EXPECT_EQ(list().topLevelItemCount(), 6);
    EXPECT_EQ(valueOf("tries"), "5");
}

TEST_F(IntersectionDataTest, LogIsForAllPlotsThatHaveNumbers) {
    selectPath();
    choose({"pdf", "material"});
    for (QToolButton* button : host->view()->findChildren<QToolButton*>())
        if (button->text() == "Log") QTest::mouseClick(button, Qt::LeftButton);
    for (PlotWidget* plot : plots()) EXPECT_EQ(plot->isLog(), plot->plot().yAxis().quantity == "pdf");
}

}  // namespace
}  // namespace emca::explorer
