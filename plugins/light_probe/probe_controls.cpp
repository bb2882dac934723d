#include "probe_controls.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QSpinBox>
#include <QStackedWidget>
#include <QToolButton>
#include <QVBoxLayout>

#include "emca/analysis/format.h"

namespace emca::light_probe {

namespace {

using explorer::Spacing;

constexpr std::uint32_t kDefaultWidth = 256;
constexpr int kWidths[] = {64, 128, 256, 512, 1024, 2048};

QToolButton* toggle(const QString& text, const QString& name, const QString& tip) {
    auto* button = new QToolButton;
    button->setText(text);
    button->setCheckable(true);
    button->setObjectName(name);
    button->setToolTip(tip);
    return button;
}

QHBoxLayout* row() {
    auto* layout = new QHBoxLayout;
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(Spacing::tiny);
    return layout;
}

}  // namespace

RequestControls::RequestControls(explorer::PluginContext& context, QWidget* parent) : QWidget(parent), context_(context) {
    update_ = new QPushButton(tr("Update"));
    update_->setObjectName("probeUpdate");
    update_->setProperty("primary", true);
    update_->setMinimumWidth(80);
    update_->setToolTip(tr("Render the light probe of the selected vertex (U)"));
    automatic_ = toggle(tr("Auto"), "probeAuto", tr("Render a new probe whenever another vertex is selected (A)"));
    save_ = new QToolButton;
    save_->setText(tr("Save…"));
    save_->setObjectName("probeSave");
    save_->setToolTip(tr("Save the radiance as EXR, or the picture as shown as PNG (S)"));
    size_ = new QComboBox;
    size_->setObjectName("probeSize");
    size_->setToolTip(tr("Size of the probe in pixels: longitudes x latitudes"));
    for (const int width : kWidths) size_->addItem(QStringLiteral("%1 x %2").arg(width).arg(width / 2), width);
    samples_ = new QSpinBox;
    samples_->setObjectName("probeSamples");
    samples_->setRange(1, static_cast<int>(probe::kMaximumProbeSamples));
    samples_->setSuffix(tr(" spp"));
    samples_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    samples_->setToolTip(tr("Samples per pixel of the probe"));
    depth_ = new QSpinBox;
    depth_->setObjectName("probeDepth");
    depth_->setRange(0, 1000);
    depth_->setPrefix(tr("depth "));
    depth_->setSpecialValueText(tr("scene's depth"));
    depth_->setToolTip(tr("Longest path in segments, from the vertex on: 1 shows emitters, 2 adds direct light; 0: as the scene says"));
    for (QSpinBox* box : {samples_, depth_}) {
        box->setKeyboardTracking(false);
        box->setMinimumWidth(64);
    }
    progress_ = new QProgressBar;
    progress_->setTextVisible(false);
    progress_->setFixedHeight(3);
    progress_->setRange(0, 1000);

    auto* above = row();
    above->addWidget(update_);
    above->addWidget(automatic_);
    above->addStretch();
    above->addWidget(save_);
    auto* below = row();
    below->addWidget(size_, 5);
    below->addWidget(samples_, 4);
    below->addWidget(depth_, 5);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(Spacing::tiny);
    layout->addLayout(above);
    layout->addLayout(below);
    layout->addWidget(progress_);
    setProgress(-1);
    read();

    connect(update_, &QPushButton::clicked, this, [this] { running_ ? emit stopWanted() : emit updateWanted(); });
    connect(save_, &QToolButton::clicked, this, &RequestControls::saveWanted);
    connect(automatic_, &QToolButton::toggled, this, [this] {
        write();
        if (!reading_) emit automaticChanged();
    });
    const auto edited = [this] {
        write();
        if (!reading_) emit changed();
    };
    connect(size_, qOverload<int>(&QComboBox::currentIndexChanged), this, edited);
    connect(samples_, qOverload<int>(&QSpinBox::valueChanged), this, edited);
    connect(depth_, qOverload<int>(&QSpinBox::valueChanged), this, edited);
}

std::uint32_t RequestControls::imageWidth() const { return size_->currentData().toUInt(); }
std::uint32_t RequestControls::samples() const { return static_cast<std::uint32_t>(samples_->value()); }
std::int32_t RequestControls::depth() const { return depth_->value(); }
bool RequestControls::isAutomatic() const { return automatic_->isChecked(); }

void RequestControls::read() {
    reading_ = true;
    size_->setCurrentIndex(std::max(0, size_->findData(context_.setting("width", kDefaultWidth).toInt())));
    samples_->setValue(context_.setting("samples", 16).toInt());
    depth_->setValue(context_.setting("depth", 0).toInt());
    automatic_->setChecked(context_.setting("auto", true).toBool());
    reading_ = false;
}

void RequestControls::write() {
    if (reading_) return;
    context_.setSetting("width", imageWidth());
    context_.setSetting("samples", samples());
    context_.setSetting("depth", depth());
    context_.setSetting("auto", isAutomatic());
}

void RequestControls::setProgress(double fraction) {
    running_ = fraction >= 0;
    update_->setText(running_ ? tr("Stop") : tr("Update"));
    progress_->setValue(static_cast<int>(1000 * fraction));
    QSizePolicy policy = progress_->sizePolicy();
    policy.setRetainSizeWhenHidden(true);
    progress_->setSizePolicy(policy);
    progress_->setVisible(running_);
}

void RequestControls::setPossible(bool possible) { update_->setEnabled(possible || running_); }

LookControls::LookControls(explorer::PluginContext& context, QWidget* parent) : QWidget(parent), context_(context) {
    projection_ = new QComboBox;
    projection_->setObjectName("probeProjection");
    projection_->addItems({tr("Latitude, longitude"), tr("Two hemispheres"), tr("Upper hemisphere")});
    projection_->setToolTip(tr("How the sphere is laid flat; hemispheres keep areas"));
    orientation_ = new QComboBox;
    orientation_->setObjectName("probeOrientation");
    orientation_->addItems({tr("World"), tr("Surface")});
    orientation_->setToolTip(tr("What is up. World: the camera's up; the middle looks back towards the camera.\n"
                                "Surface: the normal; a mirror would send the path to the middle. The dashed line is the surface's horizon."));
    falseColor_ = toggle(tr("False colour"), "probeFalseColor", tr("Luminance through a colour map (C)"));
    pages_ = new QStackedWidget;
    pages_->addWidget(exposurePage());
    pages_->addWidget(falseColorPage());
    pages_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);

    for (QComboBox* box : {projection_, orientation_}) {
        box->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        box->setMinimumContentsLength(6);
    }
    auto* above = row();
    above->addWidget(projection_, 3);
    above->addWidget(orientation_, 2);
    auto* below = row();
    below->addWidget(falseColor_);
    below->addWidget(pages_, 1);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(Spacing::tiny);
    layout->addLayout(above);
    layout->addLayout(below);
    read();

    const auto viewed = [this] {
        write();
        if (!reading_) emit viewChanged();
    };
    const auto styled = [this] {
        write();
        pages_->setCurrentIndex(falseColor() ? 1 : 0);
        if (!reading_) emit styleChanged();
    };
    connect(projection_, qOverload<int>(&QComboBox::currentIndexChanged), this, viewed);
    connect(orientation_, qOverload<int>(&QComboBox::currentIndexChanged), this, viewed);
    connect(falseColor_, &QToolButton::toggled, this, styled);
    connect(exposure_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, styled);
    connect(map_, qOverload<int>(&QComboBox::currentIndexChanged), this, styled);
    connect(log_, &QToolButton::toggled, this, [this, styled] {
        typed_ = false;
        styled();
    });
    connect(automatic_, &QToolButton::clicked, this, [this] {
        typed_ = false;
        emit styleChanged();
    });
    for (QLineEdit* edit : {minimum_, maximum_}) {
        connect(edit, &QLineEdit::editingFinished, this, [this, edit] {
            if (!edit->isModified()) return;
            typed_ = true;
            emit styleChanged();
        });
    }
}

QWidget* LookControls::exposurePage() {
    auto* page = new QWidget;
    exposure_ = new QDoubleSpinBox;
    exposure_->setObjectName("probeExposure");
    exposure_->setRange(-20, 20);
    exposure_->setSingleStep(0.5);
    exposure_->setDecimals(1);
    exposure_->setPrefix(tr("exposure "));
    exposure_->setSuffix(tr(" EV"));
    exposure_->setToolTip(tr("Stops on top of the image's exposure (E, Shift+E)"));
    auto* layout = row();
    layout->addWidget(exposure_);
    layout->addStretch();
    page->setLayout(layout);
    return page;
}

QWidget* LookControls::falseColorPage() {
    auto* page = new QWidget;
    map_ = new QComboBox;
    map_->setObjectName("probeMap");
    map_->setToolTip(tr("Colour map"));
    for (std::size_t i = 0; i < analysis::kColorMapCount; ++i) {
        const auto& map = analysis::ColorMap::get(static_cast<analysis::ColorMapId>(i));
        if (!map.isDiverging()) map_->addItem(QString::fromUtf8(map.name().data(), static_cast<int>(map.name().size())), static_cast<int>(i));
    }
    map_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    map_->setMinimumContentsLength(5);
    minimum_ = new QLineEdit;
    maximum_ = new QLineEdit;
    minimum_->setToolTip(tr("Luminance of the first colour, W/(sr m²)"));
    maximum_->setToolTip(tr("Luminance of the last colour, W/(sr m²)"));
    for (QLineEdit* edit : {minimum_, maximum_}) edit->setFixedWidth(76);
    minimum_->setAlignment(Qt::AlignRight);
    log_ = toggle(tr("Log"), "probeLog", tr("Logarithmic range (L)"));
    automatic_ = new QToolButton;
    automatic_->setText(tr("Fit"));
    automatic_->setToolTip(tr("Range from the probe: 0.5 % to 99.5 % of its pixels, logarithmic up to the brightest"));
    auto* layout = row();
    layout->addWidget(map_, 2);
    layout->addWidget(log_);
    layout->addWidget(automatic_);
    page->setLayout(layout);
    return page;
}

Projection LookControls::projection() const { return static_cast<Projection>(projection_->currentIndex()); }
Orientation LookControls::orientation() const { return static_cast<Orientation>(orientation_->currentIndex()); }
bool LookControls::falseColor() const { return falseColor_->isChecked(); }
bool LookControls::logarithmic() const { return log_->isChecked(); }
analysis::ColorMapId LookControls::map() const { return static_cast<analysis::ColorMapId>(map_->currentData().toInt()); }
double LookControls::exposure() const { return exposure_->value(); }
void LookControls::changeExposure(double stops) { exposure_->setValue(exposure_->value() + stops); }
void LookControls::toggleFalseColor() { falseColor_->toggle(); }
void LookControls::toggleLog() { log_->toggle(); }

std::optional<analysis::ValueRange> LookControls::typedRange() const {
    bool first = false, second = false;
    const analysis::ValueRange range{minimum_->text().toDouble(&first), maximum_->text().toDouble(&second), logarithmic()};
    if (!typed_ || !first || !second) return std::nullopt;
    return range.repaired();
}

void LookControls::showRange(const analysis::ValueRange& range) {
    minimum_->setText(QString::fromStdString(analysis::formatNumber(range.min)));
    maximum_->setText(QString::fromStdString(analysis::formatNumber(range.max)));
    for (QLineEdit* edit : {minimum_, maximum_}) edit->setModified(false);
}

void LookControls::read() {
    reading_ = true;
    projection_->setCurrentIndex(std::clamp(context_.setting("projection", 0).toInt(), 0, 2));
    orientation_->setCurrentIndex(std::clamp(context_.setting("orientation", 0).toInt(), 0, 1));
    falseColor_->setChecked(context_.setting("falseColor", false).toBool());
    log_->setChecked(context_.setting("log", true).toBool());
    exposure_->setValue(context_.setting("exposure", 0.0).toDouble());
    map_->setCurrentIndex(std::max(0, map_->findData(context_.setting("map", 2).toInt())));
    pages_->setCurrentIndex(falseColor() ? 1 : 0);
    reading_ = false;
}

void LookControls::write() {
    if (reading_) return;
    context_.setSetting("projection", projection_->currentIndex());
    context_.setSetting("orientation", orientation_->currentIndex());
    context_.setSetting("falseColor", falseColor());
    context_.setSetting("log", logarithmic());
    context_.setSetting("exposure", exposure());
    context_.setSetting("map", map_->currentData());
}

DirectionLegend::DirectionLegend(explorer::PluginContext& context, QWidget* parent) : QWidget(parent), context_(context) {
    static const struct { const char* name; const char* text; const char* tip; } kKinds[kDirectionKinds] = {
        {"incoming", QT_TR_NOOP("in"), QT_TR_NOOP("Where the path came from")},
        {"outgoing", QT_TR_NOOP("out"), QT_TR_NOOP("Where the path goes on to")},
        {"emitter", QT_TR_NOOP("light"), QT_TR_NOOP("Where the path goes on to: an emitter or the environment")},
        {"visible", QT_TR_NOOP("NEE"), QT_TR_NOOP("Next-event estimation: the light is visible")},
        {"occluded", QT_TR_NOOP("shadow"), QT_TR_NOOP("Next-event estimation: something is in between")},
        {"other", QT_TR_NOOP("others"), QT_TR_NOOP("Where other paths of this pixel go on to that are here too\n(nearer than 2 % of the length of the segment that leads here)")},
    };
    auto* layout = row();
    layout->setSpacing(0);
    for (int i = 0; i < kDirectionKinds; ++i) {
        auto* button = toggle(tr(kKinds[i].text), QStringLiteral("probeShow-") + kKinds[i].name, tr(kKinds[i].tip));
        button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
        button->setProperty("legend", true);
        button->setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
        buttons_[static_cast<std::size_t>(i)] = button;
        layout->addWidget(button);
        connect(button, &QToolButton::toggled, this, [this, key = QStringLiteral("show-") + kKinds[i].name](bool shown) {
            if (reading_) return;
            context_.setSetting(key, shown);
            emit changed();
        });
    }
    layout->addStretch();
    setLayout(layout);
    read();
    restyle();
}

void DirectionLegend::read() {
    reading_ = true;
    for (QToolButton* button : buttons_) button->setChecked(context_.setting(button->objectName().mid(5).toLower(), true).toBool());
    reading_ = false;
}

bool DirectionLegend::isShown(DirectionKind kind) const { return buttons_[static_cast<std::size_t>(kind)]->isChecked(); }

void DirectionLegend::restyle() {
    for (int i = 0; i < kDirectionKinds; ++i) {
        const double ratio = devicePixelRatioF();
        QPixmap picture(QSize(16, 16) * ratio);
        picture.setDevicePixelRatio(ratio);
        picture.fill(Qt::transparent);
        QPainter painter(&picture);
        const auto kind = static_cast<DirectionKind>(i);
        paintDirection(painter, QPointF(8, 8), kind, kind == DirectionKind::other ? 7 : 12, context_.colors());
        painter.end();
        QPixmap dim(picture.size());
        dim.setDevicePixelRatio(ratio);
        dim.fill(Qt::transparent);
        painter.begin(&dim);
        painter.setOpacity(0.3);
        painter.drawPixmap(0, 0, picture);
        painter.end();
        QIcon icon;
        icon.addPixmap(picture, QIcon::Normal, QIcon::On);
        icon.addPixmap(dim, QIcon::Normal, QIcon::Off);
        buttons_[static_cast<std::size_t>(i)]->setIcon(icon);
        buttons_[static_cast<std::size_t>(i)]->setFont(context_.smallFont());
        // Switched on is the rule, so that shows nothing; what is off is dimmed.
        buttons_[static_cast<std::size_t>(i)]->setStyleSheet(
            QStringLiteral("QToolButton { padding: 2px 1px; color: %1; } QToolButton:checked { background: transparent; border-color: transparent; color: %2; }")
                .arg(context_.colors().mutedText.name(), context_.colors().text.name()));
    }
}

}  // namespace emca::light_probe
