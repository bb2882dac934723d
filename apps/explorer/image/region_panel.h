#pragma once

#include <QThreadPool>
#include <QTimer>
#include <QWidget>
#include <cstdint>
#include <memory>

#include "base/listeners.h"
#include "image/region_numbers.h"

class QCheckBox;
class QLabel;
class QPushButton;
class QTableWidget;
class QToolButton;

namespace emca::explorer {

class RegionHistogram;
struct RegionStatistic;
class StateOverlay;
class Theme;

/// The pixels that are chosen together: what their values are (beside those of the reference), how often which occurs,
/// and what was traced of them. Without a region the numbers are those of the whole image.
class RegionPanel : public QWidget {
    Q_OBJECT
  public:
    RegionPanel(client::Dataset& dataset, client::Selection& selection, Theme& theme, QWidget* parent = nullptr);
    ~RegionPanel() override;

    /// Numbers stand beside those of the image if both have the same size. \param reference  null: none
    void setReference(std::shared_ptr<const RenderedImage> reference, const QString& title);
    /// What the filter view asks; empty if nothing, or nothing that can be asked.
    void setFilter(const QString& query);
    /// What the session says about the region's paths.
    struct Tracing {
        bool connected = false, running = false;
        std::uint64_t heldBack = 0;   ///< paths that wait for a word
        friend bool operator==(const Tracing&, const Tracing&) = default;
    };
    void setTracing(const Tracing& tracing);
    bool onlyMatches() const;
    void setOnlyMatches(bool on);
    void setLog(bool log);
    bool isLog() const { return log_; }

    const RegionNumbers& numbers() const { return numbers_; }
    RegionHistogram& histogram() { return *histogram_; }
    QTableWidget& table() { return *table_; }
    QString titleText() const;
    QString pathsText() const;   ///< how many paths of how many pixels, and how exact their replay is
    QString warningText() const; ///< what did not fit, or was not traced
    bool isSettled() const { return !computing_ && !later_.isActive(); }

  signals:
    void traceWanted();
    /// Regions are to be traced with this query; empty: without one.
    void queryWanted(const QString& query);

  protected:
    void showEvent(QShowEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    void build();
    void changed(bool soon);
    void compute();
    void take(RegionNumbers numbers);
    void fillTable();
    void fillRow(int row, const RegionStatistic& statistic, bool ofReference);
    QString aboutText() const;
    void showPaths();
    void tellQuery();
    void copy();
    bool isTraced() const;   ///< what the views show are the paths of the region

    client::Dataset& dataset_;
    client::Selection& selection_;
    Theme& theme_;
    std::shared_ptr<const RenderedImage> reference_;
    QString referenceTitle_, filter_, told_;
    Tracing tracing_;
    RegionWish wish_;            ///< of numbers_, or of those that are being computed
    RegionNumbers numbers_;
    bool log_ = false, stale_ = true, computing_ = false;
    std::uint64_t question_ = 0;
    QTimer later_, queryLater_;
    QThreadPool pool_;
    QLabel *title_, *about_, *paths_, *warning_;
    QTableWidget* table_;
    RegionHistogram* histogram_;
    QToolButton *logValues_, *logCounts_;
    QCheckBox* onlyMatches_;
    QPushButton *trace_, *clear_;
    StateOverlay* overlay_;
    DatasetListening datasetListening_;
    SelectionListening selectionListening_;
};

}  // namespace emca::explorer
