#include "image/image_actions.h"

#include <QAction>
#include <QKeySequence>
#include <QWidget>
#include <algorithm>
#include <cmath>

#include "image/image_model.h"

namespace emca::explorer {
namespace {

constexpr double kMostStops = 12;

/// `by` steps on in a round of `count`.
int stepped(int at, int by, int count) { return ((at + by) % count + count) % count; }

}  // namespace

ImageActions::ImageActions(ImageModel& model, QWidget& view) : QObject(&view), model_(model), view_(view) {
    constexpr bool kEverywhere = true, kHere = false;
    add("flipReference", tr("Flip between image and reference"), QKeySequence("X"), kHere,
        [this] { toggleMode(static_cast<int>(ImageMode::reference)); });
    add("splitReference", tr("Image and reference side by side"), QKeySequence("W"), kHere,
        [this] { toggleMode(static_cast<int>(ImageMode::split)); });
    add("difference", tr("Difference from the reference"), QKeySequence("D"), kHere,
        [this] { toggleMode(static_cast<int>(ImageMode::difference)); });
    add("nextMetric", tr("Next metric"), QKeySequence("M"), kHere, [this] { stepMetric(1); });
    add("previousMetric", tr("Previous metric"), QKeySequence("Shift+M"), kHere, [this] { stepMetric(-1); });
    add("openReference", tr("Open a reference…"), QKeySequence("Ctrl+Shift+O"), kEverywhere, [this] { emit openReferenceWanted(); });
    add("useAsReference", tr("Use this image as the reference"), QKeySequence("Shift+X"), kHere, [this] { model_.setReference(model_.image()); });
    add("falseColor", tr("False colour"), QKeySequence("C"), kEverywhere, [this] { toggleFalseColor(); });
    add("nextChannel", tr("Next channel"), QKeySequence("H"), kHere, [this] { stepChannel(1); });
    add("previousChannel", tr("Previous channel"), QKeySequence("Shift+H"), kHere, [this] { stepChannel(-1); });
    add("nextTransfer", tr("sRGB, gamma or linear display"), QKeySequence("G"), kHere, [this] { stepTransfer(); });
    add("brighter", tr("Half a stop brighter"), QKeySequence("E"), kHere, [this] { changeExposure(0.5); });
    add("darker", tr("Half a stop darker"), QKeySequence("Shift+E"), kHere, [this] { changeExposure(-0.5); });
    add("nextInvalid", tr("Next NaN, infinite or negative pixel"), QKeySequence("N"), kEverywhere, [this] { emit nextInvalidWanted(); });
    add("previousImage", tr("Previous image"), QKeySequence("PgUp"), kHere, [this] { emit stepImageWanted(-1); });
    add("nextImage", tr("Next image"), QKeySequence("PgDown"), kHere, [this] { emit stepImageWanted(1); });
    add("saveShown", tr("Save what is shown…"), QKeySequence("Ctrl+Shift+E"), kEverywhere, [this] { emit saveShownWanted(); });
    connect(&model_, &ImageModel::displayChanged, this, &ImageActions::refresh);
    refresh();
}

QAction* ImageActions::add(const char* name, const QString& text, const QKeySequence& keys, bool everywhere, std::function<void()> run) {
    auto* made = new QAction(text, &view_);
    made->setObjectName(name);
    made->setShortcut(keys);
    made->setShortcutContext(everywhere ? Qt::WindowShortcut : Qt::WidgetWithChildrenShortcut);
    connect(made, &QAction::triggered, this, [run = std::move(run)] { run(); });
    view_.addAction(made);
    return made;
}

void ImageActions::refresh() {
    const bool image = model_.image() != nullptr, both = image && model_.reference();
    for (QAction* action : view_.actions()) {
        const QString& name = action->objectName();
        if (name == "flipReference" || name == "splitReference" || name == "difference" || name == "nextMetric" || name == "previousMetric")
            action->setEnabled(both);
        else
            action->setEnabled(image);
    }
}

void ImageActions::setExposure(double stops) {
    ImageDisplay display = model_.display();
    display.toneMap.exposure = static_cast<float>(std::clamp(stops, -kMostStops, kMostStops));
    model_.setDisplay(display);
}

void ImageActions::changeExposure(double byStops) { setExposure(double(model_.display().toneMap.exposure) + byStops); }

void ImageActions::toggleFalseColor() {
    ImageDisplay display = model_.display();
    if (display.mustBeFalseColor()) return;
    display.scale().falseColor = !display.scale().falseColor;
    model_.setDisplay(display);
}

void ImageActions::toggleLog() {
    ImageDisplay display = model_.display();
    ValueScale& scale = display.scale();
    if (display.mustBeFalseColor() || !scale.falseColor) return;
    scale.range.log = !scale.range.log;
    scale.range = scale.range.repaired();
    scale.automatic = true;
    model_.setDisplay(display);
}

void ImageActions::stepMetric(int by) {
    const int next = stepped(static_cast<int>(model_.display().metric), by, static_cast<int>(analysis::kImageMetricCount));
    ImageDisplay display = model_.display();
    display.mode = ImageMode::difference;
    display.metric = static_cast<analysis::ImageMetric>(next);
    model_.setDisplay(display);
}

void ImageActions::stepChannel(int by) {
    const auto& values = model_.content().values;
    if (!values) return;
    const std::vector<ChannelSelect> offered = channelsOf(*values);
    const auto at = std::find(offered.begin(), offered.end(), model_.display().channel);
    const int from = at == offered.end() ? 0 : static_cast<int>(at - offered.begin());
    ImageDisplay display = model_.display();
    display.channel = offered[static_cast<std::size_t>(stepped(from, by, static_cast<int>(offered.size())))];
    model_.setDisplay(display);
}

void ImageActions::stepTransfer() {
    ImageDisplay display = model_.display();
    display.toneMap.transfer = static_cast<analysis::Transfer>(stepped(static_cast<int>(display.toneMap.transfer), 1, 3));
    model_.setDisplay(display);
}

void ImageActions::toggleMode(int mode) {
    const auto wanted = static_cast<ImageMode>(mode);
    model_.setMode(model_.display().mode == wanted ? ImageMode::image : wanted);
}

}  // namespace emca::explorer
