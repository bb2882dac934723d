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
#include "image/image_actions.h"
#include "image/image_model.h"

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

QToolButton* menuButton(const char* name, const QString& text, const QString& tip, QMenu* menu) {
    auto* button = new QToolButton;
    button->setObjectName(name);
    button->setText(text);
    button->setToolTip(tip);
    button->setPopupMode(QToolButton::InstantPopup);
    button->setMenu(menu);
    return button;
}

QLabel* muted(const QString& text) {
    auto* label = new QLabel(text);
    label->setProperty("role", "muted");
    return label;
}

QString numberText(double value) { return toQString(analysis::formatNumber(value)); }

/// "Luminance", "diffuse", "standard error"; long names are cut.
QString channelText(const ImageDisplay& display) {
    const bool error = display.samplingError && display.mode != ImageMode::difference;
    QString shown = toQString(error ? display.quantity() : text(display.channel));
    if (error && display.channel.kind != ChannelSelect::Kind::color) shown += QStringLiteral(", ") + toQString(text(display.channel));
    return shown.size() > 22 ? shown.left(21) + QStringLiteral("…") : shown;
}

}  // namespace

ImageControls::ImageControls(ImageModel& model, ImageActions& actions, Theme& theme, QWidget* parent)
    : QWidget(parent), model_(model), actions_(actions), theme_(theme), pages_(new QStackedWidget),
      falseColor_(toggle(tr("False colour"), tr("Show luminance or a channel through a colour map (C)"))),
      channel_(menuButton("channel", tr("RGB"), tr("Channel, or spread of the samples (H next, Shift+H previous)"), channelMenu())),
      display_(menuButton("display", tr("Display"), tr("Transfer curve (G) and marks"), displayMenu())) {
    falseColor_->setObjectName("falseColor");
    pages_->addWidget(tonePage());
    pages_->addWidget(falseColorPage());
    pages_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(Spacing::medium, Spacing::tiny, Spacing::small, Spacing::tiny);
    layout->setSpacing(Spacing::tiny);
    layout->addWidget(pages_, 1);
    for (QToolButton* button : {falseColor_, channel_, display_}) layout->addWidget(button);
    connect(falseColor_, &QToolButton::clicked, this, [this] {
        actions_.toggleFalseColor();
        refresh();
    });
    connect(&model_, &ImageModel::displayChanged, this, &ImageControls::refresh);
    refresh();
}

template <typename Change>
void ImageControls::change(Change change) {
    ImageDisplay display = model_.display();
    change(display);
    model_.setDisplay(display);
}

template <typename Change>
void ImageControls::addChoice(QMenu* menu, const QString& text, bool on, Change changes) {
    QAction* action = menu->addAction(text);
    action->setCheckable(true);
    action->setChecked(on);
    connect(action, &QAction::triggered, this, [this, changes] { change(changes); });
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
    exposureValue_->setToolTip(tr("Exposure in stops: 1 EV is twice as bright"));
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
    connect(exposure_, &QSlider::valueChanged, this, [this](int v) { actions_.setExposure(v / 10.0); });
    connect(exposureValue_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double v) { actions_.setExposure(v); });
    connect(reset, &QToolButton::clicked, this, [this] { actions_.setExposure(0); });
    return page;
}

QWidget* ImageControls::falseColorPage() {
    auto* page = new QWidget;
    auto* layout = new QHBoxLayout(page);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(Spacing::tiny);
    map_ = new QComboBox;
    map_->setObjectName("colorMap");
    map_->setToolTip(tr("Colour map"));
    for (std::size_t i = 0; i < analysis::kColorMapCount; ++i)
        map_->addItem(toQString(analysis::name(static_cast<analysis::ColorMapId>(i))));
    map_->setMaxVisibleItems(static_cast<int>(analysis::kColorMapCount));
    minimum_ = new QLineEdit;
    minimum_->setObjectName("rangeMinimum");
    maximum_ = new QLineEdit;
    maximum_->setObjectName("rangeMaximum");
    for (QLineEdit* edit : {minimum_, maximum_}) {
        edit->setFixedWidth(84);
        edit->setAlignment(Qt::AlignRight);
        edit->setFont(theme_.numberFont());
        edit->setToolTip(edit == minimum_ ? tr("Value of the first colour") : tr("Value of the last colour"));
        connect(edit, &QLineEdit::editingFinished, this, &ImageControls::rangeTyped);
    }
    automatic_ = toggle(tr("Auto"), {});
    automatic_->setObjectName("automaticRange");
    automatic_->setPopupMode(QToolButton::MenuButtonPopup);
    automatic_->setMenu(rangeMenu());
    log_ = toggle(tr("Log"), tr("Logarithmic colours (L)"));
    log_->setObjectName("logColors");
    layout->addWidget(map_);
    layout->addWidget(minimum_);
    layout->addWidget(muted(QStringLiteral("–")));
    layout->addWidget(maximum_);
    layout->addWidget(automatic_);
    layout->addWidget(log_);
    layout->addStretch(1);
    connect(map_, qOverload<int>(&QComboBox::activated), this, [this](int index) {
        change([index](ImageDisplay& d) { d.scale().colorMap = static_cast<analysis::ColorMapId>(index); });
    });
    connect(automatic_, &QToolButton::clicked, this, [this] { model_.setAutomaticRange(model_.display().tail); });
    connect(log_, &QToolButton::clicked, this, [this] {
        actions_.toggleLog();
        refresh();
    });
    return page;
}

QMenu* ImageControls::rangeMenu() {
    auto* menu = new QMenu(this);
    connect(menu, &QMenu::aboutToShow, this, [this, menu] {
        menu->clear();
        menu->addSection(tr("Range of the pixels"));
        for (const double tail : {0.0, 0.001, 0.005, 0.02, 0.05}) {
            const QString text = tail == 0 ? tr("All") : tr("%1 % to %2 %").arg(100 * tail).arg(100 - 100 * tail);
            QAction* action = menu->addAction(text);
            action->setCheckable(true);
            action->setChecked(model_.display().scale().automatic && model_.display().tail == tail);
            connect(action, &QAction::triggered, this, [this, tail] { model_.setAutomaticRange(tail); });
        }
    });
    return menu;
}

QMenu* ImageControls::channelMenu() {
    auto* menu = new QMenu(this);
    // Filled when it opens, because the channels are those of the image.
    connect(menu, &QMenu::aboutToShow, this, [this, menu] {
        menu->clear();
        menu->setToolTipsVisible(true);
        const ImageDisplay& display = model_.display();
        menu->addSection(tr("Channel"));
        if (model_.content().values)
            for (const ChannelSelect& select : channelsOf(*model_.content().values))
                addChoice(menu, toQString(text(select)), display.channel == select, [select](ImageDisplay& d) { d.channel = select; });
        menu->addSection(tr("Spread of the samples"));
        addChoice(menu, tr("None: the pixel's value"), !display.samplingError, [](ImageDisplay& d) { d.samplingError.reset(); });
        const bool known = model_.image() && analysis::hasVariance(*model_.image());
        for (std::size_t e = 0; e < analysis::kSamplingErrorCount; ++e) {
            const auto error = static_cast<analysis::SamplingError>(e);
            QString name = toQString(analysis::name(error));
            name[0] = name[0].toUpper();
            addChoice(menu, name, display.samplingError == error, [error](ImageDisplay& d) {
                d.samplingError = error;
                if (d.mode == ImageMode::difference) d.mode = ImageMode::image;
            });
            menu->actions().back()->setEnabled(known);
            if (!known) menu->actions().back()->setToolTip(tr("This image came without samples and variance per pixel"));
        }
    });
    return menu;
}

QMenu* ImageControls::displayMenu() {
    auto* menu = new QMenu(this);
    connect(menu, &QMenu::aboutToShow, this, [this, menu] {
        menu->clear();
        const analysis::ToneMap& tone = model_.display().toneMap;
        menu->addSection(tr("Transfer"));
        addChoice(menu, tr("sRGB"), tone.transfer == analysis::Transfer::srgb, [](ImageDisplay& d) { d.toneMap.transfer = analysis::Transfer::srgb; });
        for (const float gamma : {1.8f, 2.2f, 2.4f})
            addChoice(menu, tr("Gamma %1").arg(double(gamma)), tone.transfer == analysis::Transfer::gamma && tone.gamma == gamma, [gamma](ImageDisplay& d) {
                d.toneMap.transfer = analysis::Transfer::gamma;
                d.toneMap.gamma = gamma;
            });
        addChoice(menu, tr("Linear"), tone.transfer == analysis::Transfer::linear, [](ImageDisplay& d) { d.toneMap.transfer = analysis::Transfer::linear; });
        menu->addSection(tr("Marks"));
        addChoice(menu, tr("NaN, infinite and negative pixels"), tone.markInvalid,
                  [](ImageDisplay& d) { d.toneMap.markInvalid = !d.toneMap.markInvalid; });
        addChoice(menu, tr("Clipped pixels"), tone.markClipped, [](ImageDisplay& d) { d.toneMap.markClipped = !d.toneMap.markClipped; });
    });
    return menu;
}

void ImageControls::refresh() {
    const ImageDisplay& display = model_.display();
    const ImageStyle style = display.style();
    const QSignalBlocker a(exposure_), b(exposureValue_), c(map_);
    exposure_->setValue(static_cast<int>(std::lround(style.toneMap.exposure * 10)));
    exposureValue_->setValue(double(style.toneMap.exposure));
    pages_->setCurrentIndex(style.falseColor ? 1 : 0);
    falseColor_->setChecked(style.falseColor);
    falseColor_->setEnabled(!display.mustBeFalseColor());
    log_->setChecked(style.range.log);
    log_->setEnabled(!display.mustBeFalseColor());
    automatic_->setChecked(display.scale().automatic);
    automatic_->setToolTip(display.tail > 0 ? tr("From the %1th to the %2th percentile of the pixels").arg(100 * display.tail).arg(100 - 100 * display.tail)
                                            : tr("From the smallest to the largest value"));
    map_->setCurrentIndex(static_cast<int>(style.colorMap));
    minimum_->setText(numberText(style.range.min));
    maximum_->setText(numberText(style.range.max));
    if (const QString shown = channelText(display); shown != channel_->text()) channel_->setText(shown);
}

void ImageControls::rangeTyped() {
    const analysis::ValueRange before = model_.display().scale().range;
    // What was typed has fewer digits than what is kept: only a change of the text is an edit.
    if (minimum_->text() == numberText(before.min) && maximum_->text() == numberText(before.max)) return;
    bool first = false, second = false;
    analysis::ValueRange range = before;
    range.min = minimum_->text().toDouble(&first);
    range.max = maximum_->text().toDouble(&second);
    if (first && second)
        change([&](ImageDisplay& d) {
            d.scale().range = range.repaired();
            d.scale().automatic = false;
        });
    refresh();
}

}  // namespace emca::explorer
