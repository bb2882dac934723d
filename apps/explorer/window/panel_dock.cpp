#include "window/panel_dock.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QMainWindow>
#include <QToolButton>
#include <QVariant>

#include "base/theme.h"

namespace emca::explorer {

PanelDock::PanelDock(const QString& title, const QString& name, QWidget* content, QWidget* parent)
    : QDockWidget(title, parent), title_(new QWidget(this)), none_(new QWidget(this)), label_(new QLabel(title)) {
    setObjectName(name);
    setWidget(content);
    label_->setProperty("role", "muted");
    auto* close = new QToolButton;
    close->setStyleSheet("padding: 0; font-size: 16px;");
    close->setText(QStringLiteral("×"));
    close->setToolTip(tr("Hide; the menu View brings it back"));
    close->setFixedSize(22, 22);
    auto* layout = new QHBoxLayout(title_);
    layout->setContentsMargins(Spacing::medium, 3, Spacing::tiny, 3);
    layout->addWidget(label_, 1);
    layout->addWidget(close);
    connect(close, &QToolButton::clicked, this, &QDockWidget::close);
    setTitleBarWidget(title_);
    none_->setFixedHeight(0);
    none_->hide();
}

void PanelDock::updateTitle() {
    auto* window = qobject_cast<QMainWindow*>(parentWidget());
    if (!window) return;
    QWidget* wanted = window->tabifiedDockWidgets(this).isEmpty() || isFloating() ? title_ : none_;
    if (titleBarWidget() == wanted) return;
    QWidget* other = wanted == title_ ? none_ : title_;
    setTitleBarWidget(wanted);
    other->hide();
    wanted->show();
}

}  // namespace emca::explorer
