#include <fmt/format.h>

#include "io/export/csv_field.hpp"
#include "io/export/output_file.hpp"
#include "io/results/summary.hpp"

namespace holdfast::internal {

void write_margin_csv(ResultsReader& results, const std::string& path) {
  const ResultsInfo& info = results.info();
  const Result<std::vector<LayoutMargins>> margins = results.margins(0, info.layouts.size());
  if (!margins) throw h5::Failure(margins.error());
  OutputFile file(path);
  file.write(fmt::format("layout,direction,margin_g,critical_box{}\r\n",
                         info.has_margin_spread ? ",low_g,median_g,high_g" : ""));
  for (std::size_t i = 0; i < margins->size(); ++i)
    for (std::size_t direction = 0; direction < kDirectionCount; ++direction) {
      const LayoutMargins& layout = (*margins)[i];
      file.write(fmt::format("{},{},{},{}", csv_field(info.layouts[i]), kMarginDirections.at(direction).name,
                             csv_number(layout.margin.at(direction)), layout.critical_box.at(direction)));
      if (info.has_margin_spread)
        for (const auto* quantile : {&layout.spread.low, &layout.spread.median, &layout.spread.high})
          file.write("," + csv_number(quantile->at(direction)));
      file.write("\r\n");
    }
  file.close();
}

}  // namespace holdfast::internal
