#include "image/image_controls.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QSignalBlocker>
#include <QSlider>
#include <QStackedWidget>
#include <QToolButton>
#include <QVariant>
#include <algorithm>
#include <cmath>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"

namespace emca::explorer {
namespace {

constexpr double kMostStops = 12;

QToolButton* toggle(const QString& text, const QString& tip) {
    auto* button = new QToolButton;
    button->setText(text);
    button->setToolTip(tip);
    button->setCheckable(true);
    return button;
}

QLabel* muted(const QString& text) {
    auto* label = new QLabel(text);
    label->setProperty("role", "muted");
    return label;
}

}  // namespace

ImageControls::ImageControls(Theme& theme, QWidget* parent)
    : QWidget(parent), theme_(theme), pages_(new QStackedWidget),
      falseColor_(toggle(tr("False colour"), tr("Show luminance or a channel through a colour map (C)"))),
      display_(new QToolButton) {
    falseColor_->setObjectName("falseColor");
    display_->setText(tr("Display"));
    display_->setToolTip(tr("Channel, transfer curve and marks"));
    display_->setPopupMode(QToolButton::InstantPopup);
    display_->setMenu(displayMenu());
    pages_->addWidget(tonePage());
    pages_->addWidget(falseColorPage());
    pages_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(Spacing::medium, Spacing::tiny, Spacing::small, Spacing::tiny);
    layout->setSpacing(Spacing::small);
    layout->addWidget(pages_, 1);
    layout->addWidget(falseColor_);
    layout->addWidget(display_);
    connect(falseColor_, &QToolButton::clicked, this, &ImageControls::toggleFalseColor);
    showStyle();
}

QWidget* ImageControls::tonePage() {
    auto* page = new QWidget;
    auto* layout = new QHBoxLayout(page);
    layout->setContentsMargins(0, 0, 0, 0);
    exposure_ = new QSlider(Qt::Horizontal);
    exposure_->setObjectName("exposure");
    exposure_->setRange(static_cast<int>(-kMostStops * 10), static_cast<int>(kMostStops * 10));
    exposure_->setToolTip(tr("Exposure in stops (E brighter, Shift+E darker)"));
    exposureValue_ = new QDoubleSpinBox;
    exposureValue_->setRange(-kMostStops, kMostStops);
    exposureValue_->setSingleStep(0.5);
    exposureValue_->setDecimals(1);
    exposureValue_->setSuffix(tr(" EV"));
    exposureValue_->setAlignment(Qt::AlignRight);
    exposureValue_->setFixedWidth(78);
    exposureValue_->setFont(theme_.numberFont());
    auto* reset = new QToolButton;
    reset->setText(tr("Reset"));
    reset->setToolTip(tr("Exposure 0"));
    layout->addWidget(muted(tr("Exposure")));
    layout->addWidget(exposure_, 1);
    layout->addWidget(exposureValue_);
    layout->addWidget(reset);
    const auto set = [this](double stops) {
        ImageStyle style = style_;
        style.toneMap.exposure = static_cast<float>(stops);
        edited(style);
    };
    connect(exposure_, &QSlider::valueChanged, this, [set](int v) { set(v / 10.0); });
    connect(exposureValue_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, set);
    connect(reset, &QToolButton::clicked, this, [set] { set(0); });
    return page;
}

QWidget* ImageControls::falseColorPage() {
    auto* page = new QWidget;
    auto* layout = new QHBoxLayout(page);
    layout->setContentsMargins(0, 0, 0, 0);
    map_ = new QComboBox;
    for (std::size_t i = 0; i < analysis::kColorMapCount; ++i)
        map_->addItem(toQString(analysis::name(static_cast<analysis::ColorMapId>(i))));
    minimum_ = new QLineEdit;
    maximum_ = new QLineEdit;
    for (QLineEdit* edit : {minimum_, maximum_}) {
        edit->setFixedWidth(84);
        edit->setAlignment(Qt::AlignRight);
        edit->setFont(theme_.numberFont());
        connect(edit, &QLineEdit::editingFinished, this, &ImageControls::rangeTyped);
    }
    auto* automatic = new QToolButton;
    automatic->setText(tr("Auto"));
    automatic->setToolTip(tr("From the 0.5th to the 99.5th percentile of the image"));
    log_ = toggle(tr("Log"), tr("Logarithmic colours (L)"));
    layout->addWidget(map_);
    layout->addWidget(minimum_);
    layout->addWidget(muted(QStringLiteral("–")));
    layout->addWidget(maximum_);
    layout->addWidget(automatic);
    layout->addWidget(log_);
    layout->addStretch(1);
    connect(map_, qOverload<int>(&QComboBox::currentIndexChanged), this, [this](int index) {
        ImageStyle style = style_;
        style.colorMap = static_cast<analysis::ColorMapId>(index);
        edited(style);
    });
    connect(automatic, &QToolButton::clicked, this, &ImageControls::automaticRangeWanted);
    connect(log_, &QToolButton::clicked, this, &ImageControls::toggleLog);
    return page;
}

QMenu* ImageControls::displayMenu() {
    auto* menu = new QMenu(this);
    // Filled when it opens, because the channels are those of the image.
    connect(menu, &QMenu::aboutToShow, this, [this, menu] {
        menu->clear();
        const auto choice = [&](const QString& text, bool on, auto change) {
            QAction* action = menu->addAction(text);
            action->setCheckable(true);
            action->setChecked(on);
            connect(action, &QAction::triggered, this, [this, change] {
                ImageStyle style = style_;
                change(style);
                edited(style);
            });
        };
        menu->addSection(tr("Channel"));
        choice(style_.falseColor ? tr("Luminance") : tr("Colour"), style_.channel.index < 0, [](ImageStyle& s) { s.channel.index = -1; });
        for (std::size_t i = 0; i < channels_.size(); ++i)
            choice(toQString(channels_[i]), style_.channel.index == static_cast<int>(i),
                   [i](ImageStyle& s) { s.channel.index = static_cast<int>(i); });
        menu->addSection(tr("Transfer"));
        const auto transfer = [&](const QString& text, analysis::Transfer t) {
            choice(text, style_.toneMap.transfer == t, [t](ImageStyle& s) { s.toneMap.transfer = t; });
        };
        transfer(tr("sRGB"), analysis::Transfer::srgb);
        transfer(tr("Gamma 2.2"), analysis::Transfer::gamma);
        transfer(tr("Linear"), analysis::Transfer::linear);
        menu->addSection(tr("Marks"));
        choice(tr("NaN, infinite and negative pixels"), style_.toneMap.markInvalid,
               [](ImageStyle& s) { s.toneMap.markInvalid = !s.toneMap.markInvalid; });
        choice(tr("Clipped pixels"), style_.toneMap.markClipped, [](ImageStyle& s) { s.toneMap.markClipped = !s.toneMap.markClipped; });
    });
    return menu;
}

void ImageControls::setStyle(const ImageStyle& style) {
    style_ = style;
    showStyle();
}

void ImageControls::setChannels(const std::vector<std::string>& channels) {
    channels_ = channels;
    if (style_.channel.index < static_cast<int>(channels.size())) return;
    ImageStyle style = style_;
    style.channel.index = analysis::ChannelChoice::kLuminance;
    edited(style);
}

void ImageControls::edited(const ImageStyle& style) {
    if (style == style_) return;
    style_ = style;
    showStyle();
    emit styleChanged();
}

void ImageControls::showStyle() {
    const QSignalBlocker a(exposure_), b(exposureValue_), c(map_);
    exposure_->setValue(static_cast<int>(std::lround(style_.toneMap.exposure * 10)));
    exposureValue_->setValue(double(style_.toneMap.exposure));
    pages_->setCurrentIndex(style_.falseColor ? 1 : 0);
    falseColor_->setChecked(style_.falseColor);
    log_->setChecked(style_.range.log);
    map_->setCurrentIndex(static_cast<int>(style_.colorMap));
    minimum_->setText(toQString(analysis::formatNumber(style_.range.min)));
    maximum_->setText(toQString(analysis::formatNumber(style_.range.max)));
}

void ImageControls::rangeTyped() {
    bool first = false, second = false;
    ImageStyle style = style_;
    style.range.min = minimum_->text().toDouble(&first);
    style.range.max = maximum_->text().toDouble(&second);
    if (first && second) style.range = style.range.repaired();
    else style.range = style_.range;
    // What was typed has fewer digits than what is kept: only a change of the text is an edit.
    const bool same = minimum_->text() == toQString(analysis::formatNumber(style_.range.min)) &&
                      maximum_->text() == toQString(analysis::formatNumber(style_.range.max));
    if (!same) edited(style);
    showStyle();
}

void ImageControls::changeExposure(double byStops) {
    ImageStyle style = style_;
    style.toneMap.exposure = static_cast<float>(std::clamp(double(style.toneMap.exposure) + byStops, -kMostStops, kMostStops));
    edited(style);
}

void ImageControls::toggleFalseColor() {
    ImageStyle style = style_;
    style.falseColor = !style.falseColor;
    edited(style);
}

void ImageControls::toggleLog() {
    ImageStyle style = style_;
    style.range.log = !style.range.log;
    style.range = style.range.repaired();
    edited(style);
    if (style_.range.log) emit automaticRangeWanted();
}

}  // namespace emca::explorer
