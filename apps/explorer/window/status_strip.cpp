#include "window/status_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QProgressBar>
#include <QStyle>
#include <QToolButton>
#include <QVariant>

#include "base/qt_compat.h"
#include "base/theme.h"
#include "emca/analysis/format.h"
#include "session/session_controller.h"

namespace emca::explorer {
namespace {

constexpr double kShowTraceAfterSeconds = 0.25;  // shorter traces would only flicker

struct Badge {
    QString text;
    const char* tone;
    QString tip;
};

/// Of several pixels the worst decides the colour, and the number of exact ones is said.
Badge badgeOf(const std::vector<Replay>& replays) {
    const ReplayCounts counts = countReplays(replays);
    const QString tip = QObject::tr("Of %1 replayed pixels %2 have the same bits as the image, %3 are equal to 1e-4, %4 differ, "
                                    "%5 have nothing to be compared with.")
                            .arg(counts.pixels).arg(counts.exact).arg(counts.close).arg(counts.different).arg(counts.unknown);
    const QString sums = counts.sumsDiffer == 0 ? QString()
                                                : QObject::tr(" The recorded estimates of %1 pixels do not add up to the pixel: the "
                                                              "renderer records only a part.").arg(counts.sumsDiffer);
    if (counts.unknown == counts.pixels) return {QObject::tr("replay unknown"), "neutral", tip + sums};
    if (counts.exact == counts.pixels)
        return {QObject::tr("replay exact, %1 pixels").arg(counts.pixels), counts.sumsDiffer ? "warning" : "success", tip + sums};
    return {QObject::tr("replay exact: %1 of %2 pixels").arg(counts.exact).arg(counts.pixels),
            counts.worst() == Verdict::different ? "error" : "warning", tip + sums};
}

Badge badgeOf(const Replay& replay) {
    const QString colors = QObject::tr("Rendered %1, replayed %2.")
                               .arg(toQString(analysis::formatColor(replay.rendered)), toQString(analysis::formatColor(replay.replayed)));
    const QString sums = replay.sums == SumCheck::differs
                             ? QObject::tr(" The recorded estimates do not add up to the pixel: the renderer records only a part.")
                             : QString();
    switch (replay.verdict) {
        case Verdict::exact:
            return {QObject::tr("replay exact"), replay.sums == SumCheck::differs ? "warning" : "success",
                    QObject::tr("The replayed pixel has the same bits as the image. ") + colors + sums};
        case Verdict::close: return {QObject::tr("replay close"), "warning", QObject::tr("Equal to 1e-4. ") + colors + sums};
        case Verdict::different:
            return {QObject::tr("replay differs"), "error", QObject::tr("These are not the paths that made the image. ") + colors + sums};
        case Verdict::unknown: break;
    }
    return {QObject::tr("replay unknown"), "neutral", QObject::tr("There is no image to compare with.") + sums};
}

}  // namespace

StatusStrip::StatusStrip(client::Dataset& dataset, SessionController& session, Theme& theme, QWidget* parent)
    : QWidget(parent), dataset_(dataset), session_(session), theme_(theme), link_(new QLabel), activity_(new QLabel),
      progress_(new QProgressBar), cancel_(new QToolButton), last_(new QLabel), samples_(new QLabel), verdict_(new QLabel) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(26, 0, Spacing::small, 0);
    layout->setSpacing(Spacing::large);
    layout->addWidget(link_);
    layout->addStretch(1);
    layout->addWidget(activity_);
    layout->addWidget(progress_);
    layout->addWidget(cancel_);
    layout->addWidget(last_);
    layout->addWidget(samples_);
    layout->addWidget(verdict_);
    progress_->setFixedSize(160, 8);
    progress_->setTextVisible(false);
    progress_->setRange(0, 1000);
    cancel_->setText(tr("Cancel"));
    cancel_->setToolTip(tr("Ends what runs; what has arrived stays"));
    link_->setToolTip(tr("Renderer, its scene, and whether it is connected"));
    last_->setToolTip(tr("Time of the last request: in all, and in the renderer"));
    samples_->setToolTip(tr("Samples per pixel of what the views show"));
    verdict_->setProperty("role", "badge");
    verdict_->setObjectName("verdict");
    link_->setObjectName("link");
    for (QLabel* label : {activity_, last_, samples_}) {
        label->setFont(theme.numberFont());
        label->setProperty("role", "muted");
    }
    connect(cancel_, &QToolButton::clicked, this, [this] {
        if (session_.isTracing()) session_.cancelTrace();
        else if (session_.isSavingSession() || session_.isOpeningSession()) session_.cancelSession();
        else session_.cancelRender();
    });
    connect(&session, &SessionController::linkChanged, this, &StatusStrip::refresh);
    connect(&session, &SessionController::activityChanged, this, &StatusStrip::showActivity);
    connect(&theme, &Theme::themeChanged, this, qOverload<>(&QWidget::update));
    refresh();
}

void StatusStrip::refresh() {
    showLink();
    showActivity();
    showReplay();
    update();
}

void StatusStrip::showLink() {
    const QString where = toQString(session_.address().text());
    switch (session_.link()) {
        case LinkState::offline: {
            // Of a session: what it shows.
            QStringList parts{tr("Not connected")};
            if (dataset_.info()) parts << toQString(dataset_.info()->renderer) << toQString(dataset_.info()->scene);
            parts.removeAll(QString());
            link_->setText(parts.join(QStringLiteral("  ·  ")));
            break;
        }
        case LinkState::connecting: link_->setText(tr("Connecting to %1 …").arg(where)); break;
        case LinkState::reconnecting: link_->setText(tr("%1 went away; trying again …").arg(where)); break;
        case LinkState::connected: {
            QStringList parts{where};
            if (dataset_.info()) parts << toQString(dataset_.info()->renderer) << toQString(dataset_.info()->scene);
            parts.removeAll(QString());
            link_->setText(parts.join(QStringLiteral("  ·  ")));
        }
    }
}

void StatusStrip::showActivity() {
    QString text;
    double fraction = -1;
    bool cancellable = true;
    if (session_.isTracing() && session_.traceSeconds() > kShowTraceAfterSeconds) {
        text = tr("Tracing %1").arg(toQString(session_.tracedPixels().text()));
        fraction = session_.traceFraction();
    } else if (session_.isSavingSession() || session_.isOpeningSession()) {
        text = session_.isSavingSession() ? tr("Saving the session") : tr("Opening the session");
        fraction = session_.sessionFraction();
    } else if (session_.isRendering()) {
        fraction = session_.renderFraction();
        text = session_.isFetchingLayers() ? tr("Fetching layers") : fraction >= 0 ? tr("Rendering %1 %").arg(static_cast<int>(fraction * 100), 3) : tr("Rendering");
    } else if (session_.isReadingFile()) {
        text = tr("Reading the image");
        cancellable = false;
    } else if (session_.isLoadingScene()) {
        text = tr("Loading the scene");
        fraction = session_.sceneFraction();
        cancellable = false;
    }
    const bool busy = !text.isEmpty();
    activity_->setText(text);
    activity_->setVisible(busy);
    progress_->setVisible(busy);
    cancel_->setVisible(busy && cancellable);
    progress_->setRange(0, fraction < 0 ? 0 : 1000);
    progress_->setValue(static_cast<int>(fraction * 1000));
    last_->setVisible(!busy);
    last_->setText(session_.lastRequest());
}

void StatusStrip::showReplay() {
    const bool any = !dataset_.current().empty();
    samples_->setVisible(any);
    verdict_->setVisible(any);
    if (!any) return;
    std::vector<Replay> replays;
    for (const auto& trace : dataset_.current()) replays.insert(replays.end(), trace->replays.begin(), trace->replays.end());
    samples_->setText(tr("%1 spp").arg(dataset_.current().front()->samplesPerPixel));
    const Badge badge = replays.size() == 1 ? badgeOf(replays.front()) : badgeOf(replays);
    verdict_->setText(badge.text);
    verdict_->setToolTip(badge.tip);
    if (verdict_->property("tone") != QVariant(badge.tone)) {
        verdict_->setProperty("tone", badge.tone);
        verdict_->style()->unpolish(verdict_);
        verdict_->style()->polish(verdict_);
    }
}

void StatusStrip::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const ThemeColors& c = theme_.colors();
    QColor color = c.mutedText;
    if (session_.link() == LinkState::connected) color = c.success;
    else if (session_.link() != LinkState::offline) color = c.warning;
    painter.setPen(Qt::NoPen);
    painter.setBrush(color);
    painter.drawEllipse(QPointF(15, height() / 2.0), 4, 4);
}

}  // namespace emca::explorer
