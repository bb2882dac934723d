#pragma once

#include <QAbstractTableModel>
#include <span>
#include <vector>

#include "emca/analysis/outliers.h"
#include "emca/client/selection.h"

namespace emca::explorer {

/// Paths that an outlier detector found: path, value, and how many deviations it is from the mean; of the generalized ESD
/// test its statistic and the critical value that it exceeds.
class OutlierModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Column { kPath = 0, kValue = 1, kDeviations = 2, kColumnCount = 3 };
    struct Found {
        client::PathId id;
        QString name;
        double value = 0;
        double deviations = 0;  ///< signed distance from the mean in standard deviations; NaN if there is none
        double statistic = 0, critical = 0;  ///< R_i and lambda_i of the ESD test; NaN if it was not tested
    };

    explicit OutlierModel(QObject* parent = nullptr) : QAbstractTableModel(parent) {}
    /// Farthest first, NaN and infinite values before all others.
    /// \param reports  of all paths, or of the paths of each pixel: a path is so far from the mean of its report
    void setReports(const PathSet& paths, std::span<const analysis::PixelOutliers> reports, analysis::PathQuantity quantity);
    const std::vector<Found>& found() const { return found_; }
    /// Sorted, as a Selection wants them.
    std::vector<client::PathId> ids() const;

    int rowCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : int(found_.size()); }
    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : kColumnCount; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    void add(const PathSet& paths, const analysis::OutlierReport& report, analysis::PathQuantity quantity);
    std::vector<Found> found_;
    QString quantity_;
    bool tested_ = false;   ///< by the ESD test
};

}  // namespace emca::explorer
