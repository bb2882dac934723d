#pragma once

#include <QPlainTextEdit>
#include <string>

#include "emca/query/query.h"

namespace emca::explorer {

class Theme;

/// Where a query is written: a few lines, of which the piece that is wrong is underlined. Enter accepts, Shift+Enter
/// begins a line, Tab goes on. What is undone, the window knows.
class QueryField : public QPlainTextEdit {
    Q_OBJECT
  public:
    explicit QueryField(Theme& theme, QWidget* parent = nullptr);

    /// Tells nobody if it is what stands there.
    void write(const QString& text);
    std::string text() const { return toPlainText().toStdString(); }
    void underline(query::SourceRange where);
    void removeUnderline();
    QString underlined() const;  ///< the piece; empty if there is none
    QSize sizeHint() const override;
    QSize minimumSizeHint() const override { return sizeHint(); }

  signals:
    void accepted();

  protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    void restyle();
    Theme& theme_;
};

}  // namespace emca::explorer
