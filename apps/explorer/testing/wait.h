#pragma once

#include <QElapsedTimer>
#include <QTest>

namespace emca::explorer {

/// Lets events run until something holds. The limit only ends a test that has failed anyway.
template <typename Condition>
bool waitFor(Condition condition, int milliseconds = 20000) {
    QElapsedTimer clock;
    clock.start();
    while (!condition() && clock.elapsed() < milliseconds) QTest::qWait(2);
    return condition();
}

}  // namespace emca::explorer
