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
  file.write("layout,direction,margin_g,critical_box\r\n");
  for (std::size_t i = 0; i < margins->size(); ++i)
    for (std::size_t direction = 0; direction < kDirectionCount; ++direction)
      file.write(fmt::format("{},{},{},{}\r\n", csv_field(info.layouts[i]), kMarginDirections.at(direction).name,
                             csv_number((*margins)[i].margin.at(direction)), (*margins)[i].critical_box.at(direction)));
  file.close();
}

}  // namespace holdfast::internal
