#include "parallel/schedulers/ticker.hpp"

#include <atomic>
#include <catch2/catch.hpp>

namespace ticker_test {

using namespace holdfast::internal;

TEST_CASE("ticker: a last call sees what came before the end, whenever that comes", "[parallel][ticker]") {
  // At once: the thread may not have begun. Or while a call may be under way.
  for (const std::chrono::microseconds wait : {std::chrono::microseconds(0), std::chrono::microseconds(1100)}) {
    for (int run = 0; run < 200; ++run) {
      std::atomic<int> news = 0;
      int seen = -1;
      {
        const Ticker ticker(std::chrono::milliseconds(wait.count() > 0 ? 1 : 60000), [&] {
          seen = news;
          if (wait.count() > 0) std::this_thread::sleep_for(std::chrono::microseconds(300));
        });
        std::this_thread::sleep_for(wait);
        news = 1;
      }
      REQUIRE(seen == 1);
    }
  }
}

}  // namespace ticker_test
