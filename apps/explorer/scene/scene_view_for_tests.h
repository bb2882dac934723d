#pragma once

#include <gtest/gtest.h>

#include <QApplication>
#include <QImage>
#include <QTest>

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "base/path_ids.h"
#include "base/theme.h"
#include "scene_test_data.h"
#include "scene_view.h"

namespace emca::explorer::testing {

/// A visible view of 900 x 600 on hand-made or room data, without flights.
class SceneViewTest : public ::testing::Test {
  protected:
    SceneViewTest() : view_(dataset_, selection_, theme_) {
        SceneOptions options = view_.options();
        options.animate = false;
        options.legend = false;
        options.flyToSelection = false;
        view_.setOptions(options);
        view_.resize(900, 600);
        view_.show();
        if (!hasOpenGl() || !QTest::qWaitForWindowExposed(&view_)) ADD_FAILURE() << "run this test under Xvfb";
        qApp->processEvents();
    }

    QWidget& canvas() { return *view_.focusProxy(); }
    QImage picture() {
        qApp->processEvents();
        return view_.grab().toImage();
    }
    void change(const std::function<void(SceneOptions&)>& edit) {
        SceneOptions options = view_.options();
        edit(options);
        view_.setOptions(options);
    }
    client::VertexId vertex(Index path, Index number) {
        return vertexId(dataset_.paths(), dataset_.paths().vertices(path).first + number);
    }
    QPoint at(const client::VertexId& id) {
        const auto p = view_.screenPosition(id);
        if (!p) ADD_FAILURE() << "the vertex is not visible";
        return p ? p->toPoint() : QPoint();
    }
    /// Pixels near a point whose colour is near to what is asked for (largest channel difference below 40).
    static int count(const QImage& image, QPoint centre, int radius, const QColor& color, int tolerance = 40) {
        int n = 0;
        for (int y = std::max(0, centre.y() - radius); y <= std::min(image.height() - 1, centre.y() + radius); ++y)
            for (int x = std::max(0, centre.x() - radius); x <= std::min(image.width() - 1, centre.x() + radius); ++x) {
                const QColor c = image.pixelColor(x, y);
                n += std::max({std::abs(c.red() - color.red()), std::abs(c.green() - color.green()), std::abs(c.blue() - color.blue())}) < tolerance;
            }
        return n;
    }
    /// Two segments in the plane z = 0 of an empty room: straight up the middle, then to the right.
    void showHandMade(const std::vector<NextEvent>& nextEvents = {}) {
        client::Dataset::Transaction transaction(dataset_);
        dataset_.setCamera(roomCamera());
        dataset_.addTrace(traceOf(pathOf({-0.8f, -0.8f, 0}, {{0, -0.8f, 0}, {0, 0.6f, 0}, {0.8f, 0.6f, 0}}, nextEvents)));
    }

    client::Dataset dataset_;
    client::Selection selection_;
    Theme theme_;
    SceneView view_;
};

}  // namespace emca::explorer::testing
