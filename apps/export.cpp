// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "apps/about.hpp"
#include "apps/commands.hpp"
#include "apps/interrupt.hpp"
#include "apps/map_extent.hpp"
#include "apps/map_files_options.hpp"
#include "apps/map_region.hpp"
#include "apps/option_checks.hpp"
#include "apps/output.hpp"
#include "apps/picture_folder.hpp"
#include "results/config.hpp"
#include "results/map_folder.hpp"
#include "results/pictures.hpp"
#include "results/results_folder.hpp"

namespace credo::apps {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::string source, out, pictures;
  std::vector<double> region;  ///< two corners [m]; empty: the whole map
  MapFilesOptions files;
  bool force = false;
  OutputFormat format;
};

grids::EvidentialGrid read_wanted(const ExportOptions& o) {
  grids::EvidentialGrid grid = read_map_region(o.source, o.region);
  if (!o.region.empty()) grid = cut_out(grid, o.region);
  if (grid.bounding_box().empty())
    throw std::runtime_error(o.source + ": nothing was seen in this region: credo info says where the map lies");
  return grid;
}

void execute(const ExportOptions& o) {
  const Interruptible interruptible;
  const grids::EvidentialGrid grid = about(o.source, [&] { return read_wanted(o); });
  datasets::StagedFolder folder = results::stage_results(o.out, o.force);
  std::optional<PictureFolder> pictures;
  if (!o.pictures.empty()) pictures.emplace(o.pictures, o.out, folder.path(), o.force);
  const bool drawn = results::write_map_folder(grid, folder.path(), o.files.params());
  results::write_text(folder.path() / "config.yaml", results::to_yaml(CREDO_VERSION, o.source, o.region));
  if (!drawn) warn_without_pictures(grid);
  if (pictures && drawn) {
    results::write_map_pictures(pictures->path(), grid);
    pictures->publish();
  }
  Interruptible::check();
  folder.commit();
  const grids::CellBox box = grid.bounding_box();
  const double resolution_m = grid.georeference().resolution_m;
  if (o.format.json())
    print(nlohmann::ordered_json{
        {"map", o.out}, {"width", box.width}, {"height", box.height}, {"resolution_m", resolution_m}});
  else
    std::printf("map: %s (%d x %d cells of %g m)\n", o.out.c_str(), box.width, box.height, resolution_m);
}

}  // namespace

void add_export(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("export", "Writes a map, or a region of it, for ROS, as TIFF and as pictures.");
  command->footer(
      "  credo export results/office_map --map-mode scale --out office_scale      the same map in another mode\n"
      "  credo export site/map.cgrid --region 100 40 160 90 --out yard            of a map too large for pictures");
  auto o = std::make_shared<ExportOptions>();
  command->add_option("MAP", o->source, "a map.cgrid, or a folder of credo map or credo run that holds one")
      ->check(a_path())
      ->required();
  command->add_option("-o,--out", o->out, "folder for the map")->check(a_path())->required();
  add_region_option(*command, o->region);
  add_map_files_options(*command, o->files);
  command->add_option("--pictures", o->pictures, "folder for pictures: the map, its layers and its relief")
      ->check(a_path());
  command->add_flag("-f,--force", o->force, "replace a map that is already there");
  add_format_option(*command, o->format);
  command->callback([o] { execute(*o); });
}

}  // namespace credo::apps
