#include "image/compare_bar.h"

#include <QButtonGroup>
#include <QComboBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVariant>

#include "base/qt_compat.h"
#include "base/text_line.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "emca/analysis/metric_scale.h"
#include "image/image_model.h"

namespace emca::explorer {
namespace {

QString tipOf(analysis::ImageMetric metric) {
    using analysis::ImageMetric;
    switch (metric) {
        case ImageMetric::error: return CompareBar::tr("image − reference: green where the image is brighter, red where it is darker");
        case ImageMetric::absoluteError: return CompareBar::tr("|image − reference|");
        case ImageMetric::squaredError: return CompareBar::tr("(image − reference)²; its mean is the MSE");
        case ImageMetric::relativeAbsoluteError: return CompareBar::tr("|image − reference| / (|reference| + 0.01)");
        case ImageMetric::relativeSquaredError: return CompareBar::tr("(image − reference)² / (reference² + 0.01); its mean is the relMSE");
        case ImageMetric::symmetricAbsoluteError: return CompareBar::tr("SMAPE: 2 |image − reference| / (|image| + |reference| + 0.02)");
        case ImageMetric::ldrFlip: return CompareBar::tr("What a person sees who flips between the two on a screen, at exposure 0. 0 to 1");
        case ImageMetric::hdrFlip: return CompareBar::tr("The largest LDR-FLIP over the exposures that the reference has. 0 to 1");
    }
    return {};
}

}  // namespace

CompareBar::CompareBar(ImageModel& model, Theme& theme, QWidget* parent)
    : QWidget(parent), model_(model), modes_(new QButtonGroup(this)), metric_(new QComboBox),
      result_(new TextLine(theme, Qt::AlignRight | Qt::AlignVCenter, false)) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(Spacing::small, 0, Spacing::medium, Spacing::tiny);
    layout->setSpacing(Spacing::tiny);
    const auto add = [&](ImageMode mode, const char* name, const QString& text, const QString& tip) {
        auto* button = new QToolButton;
        button->setObjectName(name);
        button->setText(text);
        button->setToolTip(tip);
        button->setCheckable(true);
        modes_->addButton(button, static_cast<int>(mode));
        layout->addWidget(button);
    };
    add(ImageMode::image, "modeImage", tr("Image"), tr("The image (X flips between image and reference)"));
    add(ImageMode::reference, "modeReference", tr("Reference"), tr("The reference, pixel on pixel in the image's place (X)"));
    add(ImageMode::split, "modeSplit", tr("Split"), tr("Image at the left, reference at the right of a line that can be dragged (W)"));
    add(ImageMode::difference, "modeDifference", tr("Difference"), tr("How the image differs from the reference (D)"));
    metric_->setObjectName("metric");
    metric_->setToolTip(tr("How they are compared (M next, Shift+M previous)"));
    metric_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    metric_->setMinimumContentsLength(20);
    for (std::size_t m = 0; m < analysis::kImageMetricCount; ++m) {
        const auto metric = static_cast<analysis::ImageMetric>(m);
        metric_->addItem(toQString(analysis::name(metric)));
        metric_->setItemData(static_cast<int>(m), tipOf(metric), Qt::ToolTipRole);
    }
    metric_->setMaxVisibleItems(static_cast<int>(analysis::kImageMetricCount));
    result_->setObjectName("metricMean");
    layout->addSpacing(Spacing::tiny);
    layout->addWidget(metric_);
    layout->addWidget(result_, 1);
    connect(modes_, &QButtonGroup::idClicked, this, [this](int id) { model_.setMode(static_cast<ImageMode>(id)); });
    connect(metric_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
        ImageDisplay display = model_.display();
        display.metric = static_cast<analysis::ImageMetric>(index);
        display.mode = ImageMode::difference;
        model_.setDisplay(display);
    });
    connect(&model_, &ImageModel::displayChanged, this, &CompareBar::refresh);
    connect(&model_, &ImageModel::computingChanged, this, &CompareBar::refresh);
    refresh();
}

QString CompareBar::resultText() const {
    if (model_.sizesDiffer()) {
        const Image &image = model_.image()->color, &reference = model_.reference()->color;
        return tr("sizes differ: %1 × %2 and %3 × %4").arg(image.width()).arg(image.height()).arg(reference.width()).arg(reference.height());
    }
    if (model_.display().mode != ImageMode::difference) return {};
    if (model_.isComputing()) return tr("computing … %1 %").arg(static_cast<int>(model_.fraction() * 100));
    const ImageContent& content = model_.difference();
    if (!content.values) return {};
    QString text = tr("mean %1").arg(toQString(analysis::formatNumber(content.mean)));
    if (const auto unit = analysis::unit(model_.display().metric); !unit.empty()) text += ' ' + toQString(unit);
    if (content.incomparable) text += tr(", %1 not comparable").arg(content.incomparable);
    return text;
}

void CompareBar::refresh() {
    const bool both = model_.image() && model_.reference();
    setVisible(both);
    if (!both) return;
    if (auto* button = modes_->button(static_cast<int>(model_.display().mode))) button->setChecked(true);
    const QSignalBlocker quiet(metric_);
    metric_->setCurrentIndex(static_cast<int>(model_.display().metric));
    metric_->setToolTip(tipOf(model_.display().metric) + tr("\nM next, Shift+M previous metric"));
    const QString text = resultText();
    result_->setText(text);
    result_->setToolTip(text);
}

}  // namespace emca::explorer
