#include "probe_panel.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QVBoxLayout>
#include <cmath>

#include "color_strip.h"
#include "emca/analysis/format.h"
#include "emca/analysis/statistics.h"
#include "emca/explorer/plugin.h"
#include "emca/imageio/imageio.h"

namespace emca::light_probe {

namespace {

constexpr std::chrono::minutes kLongestProbe{30};
constexpr const char* kMarkedObject = "direction";

QString number(double value) { return QString::fromStdString(analysis::formatNumber(value)); }

/// From the darkest to the brightest that a map should tell apart.
analysis::ValueRange automaticRange(const Image& image, bool log) {
    const std::vector<float> values = analysis::scalars(image, {analysis::ChannelChoice::kLuminance});
    if (!log) return analysis::percentileRange(values);
    // A light that is a few pixels is what one looks for, so nothing is cut at the upper end.
    analysis::ValueRange range = analysis::percentileRange(values, 0.01, 1, true);
    range.min = std::max(range.min, range.max * 1e-5);
    return range.repaired();
}

/// The same path of another render may be elsewhere.
bool samePlace(const ProbeVertex& a, const ProbeVertex& b) { return a.id == b.id && a.position == b.position; }

QString wordsOf(DirectionKind kind) {
    switch (kind) {
        case DirectionKind::incoming: return QObject::tr("incoming");
        case DirectionKind::outgoing: return QObject::tr("outgoing");
        case DirectionKind::emitter: return QObject::tr("outgoing, into light");
        case DirectionKind::nextEventVisible: return QObject::tr("next event, visible");
        case DirectionKind::nextEventOccluded: return QObject::tr("next event, occluded");
        case DirectionKind::other: return QObject::tr("another path, outgoing");
    }
    return {};
}

}  // namespace

ProbePanel::ProbePanel(explorer::PluginContext& context) : context_(context) {
    request_ = new RequestControls(context);
    canvas_ = new ProbeCanvas(context);
    legend_ = new DirectionLegend(context);
    strip_ = new ColorStrip(context);
    look_ = new LookControls(context);
    place_ = new QLabel;
    values_ = new QLabel;
    place_->setObjectName("probePlace");
    values_->setObjectName("probeValues");
    for (QLabel* label : {place_, values_}) {
        label->setMinimumWidth(0);
        label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    }
    place_->setProperty("role", "muted");

    using explorer::Spacing;
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::small, Spacing::small, Spacing::small, Spacing::small);
    layout->setSpacing(Spacing::small);
    layout->addWidget(request_);
    layout->addWidget(canvas_, 1);
    range_ = new QWidget;
    auto* range = new QHBoxLayout(range_);
    range->setContentsMargins(0, 0, 0, 0);
    range->setSpacing(Spacing::tiny);
    range->addWidget(look_->minimum(), 0, Qt::AlignTop);
    range->addWidget(strip_, 1);
    range->addWidget(look_->maximum(), 0, Qt::AlignTop);
    layout->addWidget(range_);
    layout->addWidget(legend_);
    layout->addWidget(place_);
    layout->addWidget(values_);
    layout->addWidget(look_);
    setFocusProxy(canvas_);

    connect(request_, &RequestControls::updateWanted, this, &ProbePanel::requestProbe);
    connect(request_, &RequestControls::stopWanted, this, &ProbePanel::stop);
    connect(request_, &RequestControls::saveWanted, this, &ProbePanel::save);
    connect(request_, &RequestControls::automaticChanged, this, &ProbePanel::follow);
    connect(request_, &RequestControls::changed, this, [this] {
        if (request_->isAutomatic() && isVisible()) requestProbe();
    });
    connect(legend_, &DirectionLegend::changed, this, &ProbePanel::showView);
    connect(look_, &LookControls::viewChanged, this, [this] {
        showView();
        // Rendered anew, its pixels are those of the picture again.
        if (probe_ && !isStale() && request_->isAutomatic()) requestProbe();
    });
    connect(look_, &LookControls::styleChanged, this, &ProbePanel::showStyle);
    connect(canvas_, &ProbeCanvas::hoverChanged, this, &ProbePanel::showValues);
    connect(canvas_, &ProbeCanvas::markedByHand, this, &ProbePanel::showDirectionInScene);
    connect(canvas_, &ProbeCanvas::directionClicked, this, [this](const Direction& direction) {
        if (direction.end) context_.selectVertex(*direction.end);
    });
    onDataset_ = context.onDataset([this](std::uint32_t parts) {
        using client::DatasetPart;
        if (parts & (DatasetPart::currentTrace | DatasetPart::meshes | DatasetPart::info | DatasetPart::camera)) follow();
    });
    onSelection_ = context.onSelection([this](std::uint32_t parts) {
        if (parts & client::SelectionPart::vertex) follow();
    });
    onLook_ = context.onLook([this] {
        legend_->restyle();
        showStyle();
    });
    onSettings_ = context.onSettings([this] {
        request_->read();
        look_->read();
        legend_->read();
        showView();
        showStyle();
    });
    showStyle();
    follow();
}

bool ProbePanel::isStale() const { return probe_ && shown_ && (!selected_.vertex || !samePlace(*selected_.vertex, *shown_)); }

QString ProbePanel::obstacle() const {
    if (!context_.isConnected()) return tr("Light probes are rendered on request: connect to a renderer.");
    if (!context_.hasTool(probe::kLightProbeTool)) return tr("This renderer has no server tool “light probe”: docs/explorer/light-probe.md says how it gets one.");
    return selected_.obstacle;
}

void ProbePanel::follow() {
    selected_ = probeVertex(context_.dataset(), context_.selection());
    if (shown_ && selected_.vertex && samePlace(*selected_.vertex, *shown_)) {
        shown_ = selected_.vertex;   // further paths may have come
        showView();
    }
    if (isStale() || !probe_) {
        canvas_->setMarked(std::nullopt);
        context_.removeObject(kMarkedObject);
        const bool ask = request_->isAutomatic() && isVisible() && obstacle().isEmpty();
        if (ask) return requestProbe();
        task_.cancel();   // nobody waits for the vertex before
        asking_ = false;
    }
    showState();
}

void ProbePanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (!probe_ || isStale()) follow();
}

void ProbePanel::requestProbe() {
    if (const QString why = obstacle(); !why.isEmpty()) return showState();
    const ProbeVertex vertex = *selected_.vertex;
    probe::LightProbeRequest request;
    request.position = vertex.position;
    request.normal = vertex.normal;
    request.frame = frameOf(vertex, look_->orientation(), context_.dataset().camera());
    request.width = request_->imageWidth();
    request.height = request.width / 2;
    request.samplesPerPixel = request_->samples();
    request.maximumDepth = request_->depth();
    explorer::AskOptions options;
    options.timeout = kLongestProbe;
    options.progress = [this](double fraction) { request_->setProgress(fraction); };
    asking_ = true;
    request_->setProgress(0);
    task_ = context_.ask(probe::kLightProbeTool, probe::encode(request), std::move(options),
                         [this, vertex](Result<std::vector<std::byte>> reply) { received(std::move(reply), vertex); });
    showState();
}

void ProbePanel::stop() {
    task_.cancel();
    asking_ = false;
    showState();
}

void ProbePanel::received(Result<std::vector<std::byte>> reply, const ProbeVertex& vertex) {
    asking_ = false;
    auto probe = reply ? probe::decodeProbe(*reply) : Result<probe::LightProbe>(reply.error());
    if (!probe) {
        showState();
        if (probe.error().code != ErrorCode::cancelled) {
            const QString sentence = QString::fromStdString(probe.error().message);
            probe_ ? context_.sayError(sentence) : context_.showError(sentence, tr("Try again"), [this] { requestProbe(); });
        }
        return;
    }
    probe_ = std::make_shared<const probe::LightProbe>(std::move(probe).value());
    shown_ = vertex;
    if (selected_.vertex && samePlace(*selected_.vertex, vertex)) shown_ = selected_.vertex;
    canvas_->setProbe(probe_);
    showView();
    showStyle();
    showState();
}

void ProbePanel::showView() {
    for (int i = 0; i < kDirectionKinds; ++i) canvas_->setShown(static_cast<DirectionKind>(i), legend_->isShown(static_cast<DirectionKind>(i)));
    if (!shown_) return;
    // Discs around the world's up would cut the hemisphere of a wall in two halves: there, orientation counts as well.
    canvas_->setView(SphereView(frameOf(*shown_, look_->orientation(), context_.dataset().camera()), look_->projection()));
    canvas_->setDirections(shown_->directions, shown_->normal);
}

void ProbePanel::showStyle() {
    ProbeStyle style;
    style.toneMap = context_.toneMap();
    style.toneMap.exposure += static_cast<float>(look_->exposure());
    style.falseColor = look_->falseColor();
    style.map = look_->map();
    if (const auto typed = look_->typedRange()) style.range = *typed;
    else if (probe_) style.range = automaticRange(probe_->image, look_->logarithmic());
    look_->showRange(style.range);
    strip_->show(style.map, style.range);
    range_->setVisible(style.falseColor);
    canvas_->setStyle(style);
    showValues();
}

void ProbePanel::showState() {
    const QString why = obstacle();
    request_->setProgress(asking_ ? 0 : -1);
    request_->setPossible(why.isEmpty());
    if (!probe_) {
        if (!why.isEmpty()) return context_.showEmpty(tr("No light probe"), why);
        if (!asking_) return context_.showEmpty(tr("No light probe"), tr("Press U to render what %1 sees.").arg(selected_.vertex->label()));
    }
    context_.showContent();
    const QString next = why.isEmpty() ? tr("press U for that of %1").arg(selected_.vertex->label()) : QString();
    canvas_->setStale(!isStale() || !shown_ ? QString()
                      : asking_             ? tr("rendering %1 …").arg(selected_.vertex->label())
                      : next.isEmpty()      ? tr("of %1").arg(shown_->label())
                                            : tr("of %1; %2").arg(shown_->label(), next));
    showValues();
}

void ProbePanel::showValues() {
    std::optional<Vec3f> direction = canvas_->hovered();
    if (!direction) direction = canvas_->marked();
    strip_->setPointer(std::nan(""));
    values_->setFont(context_.numberFont());
    place_->setFont(context_.smallNumberFont());
    if (!probe_ || !shown_) {
        place_->clear();
        values_->clear();
        return;
    }
    if (!direction) {
        place_->setText(tr("%1 · %2 x %3, %4 spp in %5").arg(shown_->label()).arg(probe_->map.width()).arg(probe_->map.height())
                            .arg(probe_->samplesPerPixel).arg(QString::fromStdString(analysis::formatDuration(double(probe_->seconds)))));
        values_->setText(tr("Point at a direction: its radiance"));
        return;
    }
    const Vec3d local = normalize(canvas_->view().frame().toLocal(*direction));
    constexpr double kDegrees = 180 / 3.14159265358979323846;
    QString words = tr("θ %1° φ %2°").arg(std::acos(std::clamp(local.z, -1.0, 1.0)) * kDegrees, 0, 'f', 1)
                        .arg(std::atan2(-local.y, local.x) * kDegrees, 0, 'f', 1);
    words += tr(" · (%1, %2, %3)").arg(double(direction->x), 0, 'f', 3).arg(double(direction->y), 0, 'f', 3).arg(double(direction->z), 0, 'f', 3);
    if (const Direction* mark = canvas_->hoveredDirection()) words = wordsOf(mark->kind) + " · " + words;
    const float* pixel = probe_->image.at(probe_->map.pixelOf(*direction));
    const double brightness = double(luminance(Color(pixel[0], pixel[1], pixel[2])));
    place_->setText(words);
    values_->setText(tr("(%1, %2, %3)  Y %4 ± %5").arg(number(double(pixel[0])), number(double(pixel[1])), number(double(pixel[2])), number(brightness), number(double(pixel[3]))));
    values_->setToolTip(tr("Radiance in W/(sr m²): red, green, blue; luminance and its standard error"));
    strip_->setPointer(brightness);
}

void ProbePanel::showDirectionInScene() {
    showValues();
    const auto marked = canvas_->marked();
    if (!marked || !shown_) return context_.removeObject(kMarkedObject);
    const auto meshes = context_.dataset().meshes();
    const float reach = meshes ? 0.15f * boundingBox(*meshes).diagonal() : 1.f;
    explorer::SceneObject object;
    object.name = "Light probe: direction";
    object.description = "The direction that was clicked in the light probe.";
    object.shape = explorer::ArrowSet{{{shown_->position, shown_->position + *marked * reach}}, 3, true};
    const QColor color = context_.colors().selected;
    object.colors.color = {static_cast<std::uint8_t>(color.red()), static_cast<std::uint8_t>(color.green()), static_cast<std::uint8_t>(color.blue()), 255};
    object.onTop = true;
    if (auto set = context_.setObject(kMarkedObject, std::move(object)); !set) context_.sayError(QString::fromStdString(set.error().message));
}

Result<void> ProbePanel::saveTo(const QString& file) {
    if (!probe_) return Error{ErrorCode::invalidArgument, "There is no light probe to save: select a vertex and press Update."};
    if (file.endsWith(".png", Qt::CaseInsensitive)) {
        if (canvas_->grab().save(file)) return {};
        return Error{ErrorCode::fileUnwritable, "The picture cannot be written to " + file.toStdString() + ": choose another folder."};
    }
    return imageio::write(file.toStdString(), probe_->image);
}

void ProbePanel::save() {
    if (!probe_) return context_.say(tr("There is no light probe to save yet."));
    QString file = QFileDialog::getSaveFileName(this, tr("Save light probe"), tr("light-probe.exr"),
                                                tr("Radiance (*.exr);;Radiance without errors (*.pfm);;Picture as shown (*.png)"));
    if (file.isEmpty()) return;
    if (const auto saved = saveTo(file); !saved) context_.sayError(QString::fromStdString(saved.error().message));
    else context_.say(tr("Light probe saved as %1").arg(file));
}

void ProbePanel::keyPressEvent(QKeyEvent* event) {
    if (event->modifiers() & ~Qt::ShiftModifier) return QWidget::keyPressEvent(event);
    switch (event->key()) {
        case Qt::Key_U: return requestProbe();
        case Qt::Key_C: return look_->toggleFalseColor();
        case Qt::Key_L: return look_->toggleLog();
        case Qt::Key_S: return save();
        case Qt::Key_E: return look_->changeExposure(event->modifiers() & Qt::ShiftModifier ? -0.5 : 0.5);
        case Qt::Key_A:
            if (auto* automatic = findChild<QWidget*>("probeAuto")) QMetaObject::invokeMethod(automatic, "toggle");
            return;
        default: QWidget::keyPressEvent(event);
    }
}

}  // namespace emca::light_probe
