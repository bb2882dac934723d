#include "mixture_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "emca/analysis/format.h"
#include "emca/explorer/plugin.h"
#include "emca/probe/light_probe.h"
#include "lobe_picture.h"

namespace mixture {

namespace {

using namespace emca::explorer;

constexpr std::uint32_t kProbeWidth = 128, kProbeSamples = 64;
constexpr const char *kArrows = "arrows", *kBody = "body";

QString number(double value) { return QString::fromStdString(emca::analysis::formatNumber(value)); }
emca::Vec3f toFloat(Vec3d v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }
emca::analysis::Color8 toColor(const QColor& c) {
    return {static_cast<std::uint8_t>(c.red()), static_cast<std::uint8_t>(c.green()), static_cast<std::uint8_t>(c.blue()), 255};
}

/// The density as a body around the vertex: as far away as the fourth root of the density, so that a sharp lobe does not
/// flatten all others.
TriangleSet bodyOf(const std::vector<Lobe>& lobes, emca::Vec3f centre, float size) {
    constexpr std::uint32_t kColumns = 128, kRows = 64;
    TriangleSet body;
    std::vector<double> radii;
    double largest = 0;
    std::vector<Vec3d> directions;
    for (std::uint32_t y = 0; y <= kRows; ++y)
        for (std::uint32_t x = 0; x < kColumns; ++x) {
            const double theta = 3.14159265358979323846 * y / kRows, phi = 2 * 3.14159265358979323846 * x / kColumns;
            directions.push_back({std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
            radii.push_back(std::pow(density(lobes, directions.back()), 0.25));
            largest = std::max(largest, radii.back());
        }
    for (std::size_t i = 0; i < directions.size(); ++i) body.positions.push_back(centre + toFloat(directions[i] * (radii[i] / largest)) * size);
    for (std::uint32_t y = 0; y < kRows; ++y)
        for (std::uint32_t x = 0; x < kColumns; ++x) {
            const std::uint32_t a = y * kColumns + x, b = y * kColumns + (x + 1) % kColumns;
            body.triangles.push_back({a, a + kColumns, b});
            body.triangles.push_back({b, a + kColumns, b + kColumns});
        }
    return body;
}

}  // namespace

MixturePanel::MixturePanel(PluginContext& context) : context_(context) {
    fit_ = new QPushButton(tr("Fit"));
    fit_->setObjectName("mixtureFit");
    fit_->setProperty("primary", true);
    fit_->setToolTip(tr("Fit lobes to what the selected vertex sees"));
    automatic_ = new QToolButton;
    automatic_->setText(tr("Auto"));
    automatic_->setCheckable(true);
    automatic_->setChecked(context.setting("auto", true).toBool());
    automatic_->setToolTip(tr("Fit again whenever another vertex is selected"));
    source_ = new QComboBox;
    source_->setObjectName("mixtureSource");
    source_->addItems({tr("to radiance"), tr("to directions taken")});
    source_->setCurrentIndex(context.setting("source", 0).toInt() == 1 ? 1 : 0);
    source_->setToolTip(tr("Radiance: what arrives at the vertex, rendered as a light probe; what a guide should do.\n"
                           "Directions: where the paths of this pixel went on to that are here; what was done."));
    components_ = new QSpinBox;
    components_->setObjectName("mixtureComponents");
    components_->setRange(1, static_cast<int>(kMaximumComponents));
    components_->setSuffix(tr(" lobes"));
    components_->setKeyboardTracking(false);
    components_->setValue(context.setting("components", 8).toInt());
    components_->setToolTip(tr("Lobes at most"));
    picture_ = new LobePicture(context);
    words_ = new QLabel;
    words_->setProperty("role", "muted");
    words_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    table_ = new QTableWidget(0, 4);
    table_->setObjectName("mixtureTable");
    table_->setHorizontalHeaderLabels({tr("weight"), tr("kappa"), tr("half in"), tr("mean direction")});
    table_->horizontalHeaderItem(2)->setToolTip(tr("Half angle of the cone that holds half of the lobe, degrees"));
    table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    table_->horizontalHeader()->setStretchLastSection(true);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(Spacing::row);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setSelectionMode(QAbstractItemView::SingleSelection);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setShowGrid(false);

    auto* row = new QHBoxLayout;
    row->setSpacing(Spacing::tiny);
    row->addWidget(fit_);
    row->addWidget(automatic_);
    row->addWidget(source_, 1);
    row->addWidget(components_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(Spacing::small, Spacing::small, Spacing::small, Spacing::small);
    layout->setSpacing(Spacing::small);
    layout->addLayout(row);
    layout->addWidget(picture_, 1);
    layout->addWidget(words_);
    layout->addWidget(table_);
    table_->setFixedHeight(116);

    const auto changed = [this] {
        context_.setSetting("auto", automatic_->isChecked());
        context_.setSetting("source", source_->currentIndex());
        context_.setSetting("components", components_->value());
        if (automatic_->isChecked() && isVisible()) requestFit();
    };
    connect(fit_, &QPushButton::clicked, this, &MixturePanel::requestFit);
    connect(automatic_, &QToolButton::toggled, this, changed);
    connect(source_, qOverload<int>(&QComboBox::currentIndexChanged), this, changed);
    connect(components_, qOverload<int>(&QSpinBox::valueChanged), this, changed);
    connect(picture_, &LobePicture::lobeClicked, this, [this](std::size_t lobe) { table_->selectRow(static_cast<int>(lobe)); });
    connect(table_, &QTableWidget::itemSelectionChanged, this, [this] {
        const auto rows = table_->selectionModel()->selectedRows();
        chooseLobe(rows.isEmpty() ? std::nullopt : std::optional<std::size_t>(rows.front().row()));
    });
    onDataset_ = context.onDataset([this](std::uint32_t parts) {
        using emca::client::DatasetPart;
        if (parts & (DatasetPart::currentTrace | DatasetPart::meshes | DatasetPart::info | DatasetPart::camera)) follow();
    });
    onSelection_ = context.onSelection([this](std::uint32_t parts) {
        if (parts & emca::client::SelectionPart::vertex) follow();
    });
    onPick_ = context.onPick([this](const std::string& id, std::size_t element) {
        if (id == kArrows) table_->selectRow(static_cast<int>(element));
    });
    onLook_ = context.onLook([this] { picture_->update(); });
    follow();
}

void MixturePanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    follow();
}

void MixturePanel::follow() {
    selected_ = selectedVertex(context_.dataset(), context_.selection());
    if (!context_.isConnected() || !context_.hasTool(kTool)) {
        return context_.showEmpty(tr("No mixture"), tr("The renderer has no server tool “%1”: start it with --tool spherical-mixture-server.so.").arg(kTool));
    }
    if (!selected_) {
        if (!reply_) context_.showEmpty(tr("No mixture"), tr("Select a vertex on a surface: in the 3D view or in the path tree."));
        return;
    }
    context_.showContent();
    if (shown_ && shown_->id == selected_->id && shown_->position == selected_->position) return;
    context_.removeObjects();   // they would lie at the vertex before
    if (automatic_->isChecked() && isVisible()) requestFit();
    else words_->setText(tr("Another vertex is selected: press Fit."));
}

void MixturePanel::requestFit() {
    if (!selected_) return;
    const Vertex vertex = *selected_;
    Request request;
    request.components = static_cast<std::uint32_t>(components_->value());
    if (source_->currentIndex() == 0) {
        emca::probe::LightProbeRequest probe;
        probe.position = vertex.position;
        probe.normal = vertex.normal;
        probe.frame = vertex.frame;
        probe.width = kProbeWidth;
        probe.height = kProbeWidth / 2;
        probe.samplesPerPixel = kProbeSamples;
        request.lightProbe = emca::probe::encode(probe);
    } else {
        request.directions = vertex.directions;
    }
    AskOptions options;
    options.timeout = std::chrono::minutes(10);
    options.progress = [this](double fraction) { words_->setText(tr("Rendering what arrives: %1 %").arg(static_cast<int>(100 * fraction))); };
    words_->setText(tr("Fitting …"));
    task_ = context_.ask(kTool, encode(request), std::move(options), [this, vertex](emca::Result<std::vector<std::byte>> bytes) { received(std::move(bytes), vertex); });
}

void MixturePanel::received(emca::Result<std::vector<std::byte>> bytes, const Vertex& vertex) {
    auto reply = bytes ? decodeReply(*bytes) : emca::Result<Reply>(bytes.error());
    if (!reply) {
        words_->setText(QString::fromStdString(reply.error().message));
        words_->setToolTip(words_->text());
        return;
    }
    reply_ = std::move(reply).value();
    shown_ = vertex;
    showLobes();
    showInScene();
}

void MixturePanel::showLobes() {
    const auto probe = emca::probe::decodeProbe(reply_->lightProbe);
    picture_->show(shown_->frame, reply_->fit.lobes, shown_->directions, probe ? &*probe : nullptr);
    words_->setText(tr("path %1, vertex %2 · %3 steps · log-likelihood %4").arg(shown_->id.path.sample).arg(shown_->id.depth)
                        .arg(reply_->fit.iterations).arg(number(reply_->fit.logLikelihood)));
    table_->setRowCount(static_cast<int>(reply_->fit.lobes.size()));
    for (int row = 0; row < table_->rowCount(); ++row) {
        const Lobe& lobe = reply_->fit.lobes[static_cast<std::size_t>(row)];
        const QString cells[] = {tr("%1 %").arg(100 * lobe.weight, 0, 'f', 1), number(lobe.kappa),
                                 tr("%1°").arg(coneOf(lobe.kappa, 0.5) * 180 / 3.14159265358979323846, 0, 'f', 1),
                                 QStringLiteral("%1, %2, %3").arg(lobe.mean.x, 0, 'f', 3).arg(lobe.mean.y, 0, 'f', 3).arg(lobe.mean.z, 0, 'f', 3)};
        for (int column = 0; column < 4; ++column) {
            auto* item = new QTableWidgetItem(cells[column]);
            item->setFont(context_.numberFont());
            item->setTextAlignment(column < 3 ? Qt::AlignRight | Qt::AlignVCenter : Qt::AlignLeft | Qt::AlignVCenter);
            if (column == 0) item->setData(Qt::DecorationRole, lobeColor(static_cast<std::size_t>(row)));
            table_->setItem(row, column, item);
        }
    }
    table_->clearSelection();
}

/// Arrows along the means, as long as the lobes are heavy; the body is the density.
void MixturePanel::showInScene() {
    const auto meshes = context_.dataset().meshes();
    const float size = meshes && !meshes->empty() ? 0.07f * emca::boundingBox(*meshes).diagonal() : 1.f;
    const std::vector<Lobe>& lobes = reply_->fit.lobes;
    SceneObject arrows;
    arrows.name = "Mixture: lobes";
    arrows.description = "Mean directions of the lobes; the heaviest is the longest.";
    ArrowSet set;
    set.lineWidth = 3;
    for (std::size_t i = 0; i < lobes.size(); ++i) {
        const auto share = static_cast<float>(std::sqrt(lobes[i].weight / lobes.front().weight));
        set.arrows.push_back({shown_->position, shown_->position + toFloat(lobes[i].mean) * (size * 1.2f * share)});
        arrows.colors.colors.push_back(toColor(lobeColor(i)));
        arrows.labels.push_back("lobe " + std::to_string(i + 1) + ": weight " + emca::analysis::formatNumber(lobes[i].weight) + ", kappa " +
                                emca::analysis::formatNumber(lobes[i].kappa));
    }
    arrows.shape = std::move(set);
    arrows.onTop = true;
    SceneObject body;
    body.name = "Mixture: density";
    body.description = "As far from the vertex as the fourth root of the density in that direction.";
    body.shape = bodyOf(lobes, shown_->position, size);
    body.colors.color = toColor(context_.colors().accent);
    body.opacity = 0.35f;
    for (auto& [id, object] : {std::pair<const char*, SceneObject*>{kArrows, &arrows}, {kBody, &body}})
        if (auto added = context_.setObject(id, std::move(*object)); !added) context_.sayError(QString::fromStdString(added.error().message));
}

void MixturePanel::chooseLobe(std::optional<std::size_t> lobe) { picture_->setCurrent(lobe); }

}  // namespace mixture
