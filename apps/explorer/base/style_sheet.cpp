#include "base/style_sheet.h"

#include <utility>
#include <vector>

namespace emca::explorer {
namespace {

// {names} are replaced by the theme's colours. Dynamic properties: `role` of labels ("muted", "title", "badge"),
// `tone` of badges ("neutral", "success", "warning", "error"), `primary` of the one button that matters.
constexpr const char* kSheet = R"(
QToolTip { background: {raised}; color: {text}; border: 1px solid {border}; padding: 4px 6px; }
QMainWindow { background: {panel}; }
QMainWindow::separator { background: {ground}; width: 4px; height: 4px; }
QMainWindow::separator:hover { background: {accent}; }
QSplitter::handle { background: {ground}; }
QSplitter::handle:hover { background: {accent}; }

QMenuBar { background: {panel}; border-bottom: 1px solid {border}; padding: 1px 4px; }
QMenuBar::item { padding: 4px 9px; border-radius: 4px; background: transparent; }
QMenuBar::item:selected { background: {hoverSurface}; }
QMenu { background: {raised}; border: 1px solid {border}; padding: 4px 0; }
QMenu::item { padding: 5px 28px 5px 24px; }
QMenu::item:selected { background: {selectedRow}; color: {text}; }
QMenu::item:disabled { color: {mutedText}; }
QMenu::separator { height: 1px; background: {border}; margin: 4px 8px; }
QMenu::indicator { left: 6px; }

QToolBar { background: {panel}; border: none; border-bottom: 1px solid {border}; padding: 4px 8px; spacing: 6px; }
QToolBar::separator { background: {border}; width: 1px; margin: 4px 6px; }
QStatusBar { background: {panel}; border-top: 1px solid {border}; color: {mutedText}; min-height: 26px; }
QStatusBar::item { border: none; }

QDockWidget { titlebar-close-icon: none; titlebar-normal-icon: none; color: {mutedText}; }
QDockWidget::title { background: {panel}; padding: 6px 10px; text-align: left; border-bottom: 1px solid {border}; }

QTabWidget::pane { border: none; }
QTabBar { background: {panel}; }
QTabBar::tab { background: transparent; color: {mutedText}; padding: 6px 10px; border: none; border-bottom: 2px solid transparent; }
QTabBar::tab:hover { color: {text}; }
QTabBar::tab:selected { color: {text}; border-bottom: 2px solid {accent}; }
QTabBar::scroller { width: 48px; }
QTabBar QToolButton { background: {panel}; border: none; border-radius: 0; padding: 0; }
QTabBar QToolButton:hover { background: {hoverSurface}; }
QTabBar QToolButton::left-arrow { image: url(:/emca/symbols/arrow-left.svg); width: 10px; height: 10px; }
QTabBar QToolButton::right-arrow { image: url(:/emca/symbols/arrow-right.svg); width: 10px; height: 10px; }

QPushButton { background: {raised}; border: 1px solid {border}; border-radius: 4px; padding: 4px 12px; min-height: 16px; }
QPushButton:hover { background: {hoverSurface}; }
QPushButton:pressed, QPushButton:checked { background: {selectedRow}; border-color: {accent}; }
QPushButton:focus { border-color: {accent}; }
QPushButton:disabled { color: {mutedText}; background: {panel}; }
QPushButton[primary="true"] { background: {accent}; color: {onAccent}; border-color: {accent}; }
QPushButton[primary="true"]:disabled { background: {panel}; color: {mutedText}; border-color: {border}; }
QToolButton { background: transparent; border: 1px solid transparent; border-radius: 4px; padding: 4px 8px; }
QToolButton:hover { background: {hoverSurface}; }
QToolButton:pressed, QToolButton:checked { background: {selectedRow}; border-color: {accent}; }
QToolButton:disabled { color: {mutedText}; }
QToolButton::menu-indicator { image: none; }

QLineEdit, QSpinBox, QDoubleSpinBox, QPlainTextEdit, QTextEdit {
    background: {ground}; border: 1px solid {border}; border-radius: 4px; padding: 2px 6px; min-height: 18px;
    selection-background-color: {accent}; selection-color: {onAccent}; }
QLineEdit:focus, QSpinBox:focus, QDoubleSpinBox:focus, QPlainTextEdit:focus { border-color: {accent}; }
QSpinBox::up-button, QDoubleSpinBox::up-button, QSpinBox::down-button, QDoubleSpinBox::down-button { width: 0; border: none; }
QComboBox { background: {raised}; border: 1px solid {border}; border-radius: 4px; padding: 2px 8px; min-height: 18px; }
QComboBox:hover { background: {hoverSurface}; }
QComboBox:focus { border-color: {accent}; }
QComboBox::drop-down { border: none; width: 20px; }
QComboBox::down-arrow { image: url(:/emca/symbols/arrow-down.svg); width: 10px; height: 10px; }
QComboBox QAbstractItemView { background: {raised}; border: 1px solid {border}; selection-background-color: {selectedRow};
    selection-color: {text}; outline: none; }

QAbstractItemView { background: {ground}; border: none; outline: none; alternate-background-color: {ground}; }
QAbstractItemView::item { padding: 2px 4px; }
QListView#completions { background: {raised}; border: 1px solid {border}; }
QListView#completions::item { padding: 4px 6px; }
QAbstractItemView::item:hover { background: {panel}; }
QAbstractItemView::item:selected { background: {selectedRow}; color: {text}; }
QHeaderView { background: {panel}; }
QHeaderView::section { background: {panel}; color: {mutedText}; border: none; border-bottom: 1px solid {border};
    border-right: 1px solid {border}; padding: 4px 8px; }
QTableCornerButton::section { background: {panel}; border: none; }

QScrollBar:vertical { background: transparent; width: 10px; margin: 0; }
QScrollBar:horizontal { background: transparent; height: 10px; margin: 0; }
QScrollBar::handle { background: {hoverSurface}; border-radius: 3px; margin: 2px; }
QScrollBar::handle:vertical { min-height: 28px; }
QScrollBar::handle:horizontal { min-width: 28px; }
QScrollBar::handle:hover { background: {mutedText}; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }

QCheckBox, QRadioButton { spacing: 7px; }
QCheckBox::indicator, QRadioButton::indicator { width: 12px; height: 12px; border: 1px solid {mutedText}; border-radius: 3px; background: {ground}; }
QRadioButton::indicator { border-radius: 7px; }
QCheckBox::indicator:hover, QRadioButton::indicator:hover { border-color: {accent}; }
QCheckBox::indicator:checked, QRadioButton::indicator:checked { background: qradialgradient(cx:0.5, cy:0.5, radius:0.5, fx:0.5, fy:0.5,
    stop:0 {accent}, stop:0.62 {accent}, stop:0.66 {ground}, stop:1 {ground}); border-color: {accent}; }
QCheckBox::indicator:checked { background: {accent}; image: url(:/emca/symbols/{check}.svg); }
QCheckBox::indicator:disabled, QRadioButton::indicator:disabled { border-color: {border}; }

QSlider::groove:horizontal { height: 4px; background: {border}; border-radius: 2px; }
QSlider::sub-page:horizontal { background: {mutedText}; border-radius: 2px; }
QSlider::handle:horizontal { background: {text}; width: 12px; height: 12px; margin: -4px 0; border-radius: 6px; }
QSlider::handle:horizontal:hover { background: {accent}; }
QProgressBar { background: {ground}; border: 1px solid {border}; border-radius: 4px; text-align: center; height: 14px; }
QProgressBar::chunk { background: {accent}; border-radius: 3px; }
QGroupBox { border: none; margin-top: 20px; }
QGroupBox::title { subcontrol-origin: margin; left: 0; color: {mutedText}; }

QLabel[role="muted"] { color: {mutedText}; }
QLabel[role="title"] { font-weight: 600; }
QLabel[role="error"] { color: {error}; }
QLabel[role="warning"] { color: {warning}; }
QLabel[role="badge"] { border-radius: 8px; padding: 1px 8px; background: {raised}; color: {mutedText}; }
QLabel[role="badge"][tone="success"] { background: {successSurface}; color: {success}; }
QLabel[role="badge"][tone="warning"] { background: {warningSurface}; color: {warning}; }
QLabel[role="badge"][tone="error"] { background: {errorSurface}; color: {error}; }
)";

QColor mixed(const QColor& a, const QColor& b, double share) {
    const auto channel = [share](int x, int y) { return static_cast<int>(x + (y - x) * share + 0.5); };
    return {channel(a.red(), b.red()), channel(a.green(), b.green()), channel(a.blue(), b.blue())};
}

}  // namespace

QString styleSheet(const ThemeColors& c) {
    const std::vector<std::pair<const char*, QColor>> names{
        {"{ground}", c.ground}, {"{panel}", c.panel}, {"{raised}", c.raised}, {"{hoverSurface}", c.hoverSurface},
        {"{border}", c.border}, {"{text}", c.text}, {"{mutedText}", c.mutedText}, {"{accent}", c.accent},
        {"{onAccent}", c.onAccent}, {"{selectedRow}", c.selectedRow}, {"{success}", c.success}, {"{warning}", c.warning},
        {"{error}", c.error}, {"{successSurface}", mixed(c.panel, c.success, 0.18)},
        {"{warningSurface}", mixed(c.panel, c.warning, 0.18)}, {"{errorSurface}", mixed(c.panel, c.error, 0.18)},
    };
    QString sheet = QString::fromLatin1(kSheet);
    for (const auto& [name, color] : names) sheet.replace(QLatin1String(name), color.name());
    sheet.replace(QLatin1String("{check}"), QLatin1String(c.onAccent.lightness() > 128 ? "check-light" : "check-dark"));
    return sheet;
}

}  // namespace emca::explorer
