// SPDX-FileCopyrightText: The Credo Authors
// SPDX-License-Identifier: Apache-2.0

#include "apps/played_drive.hpp"

#include <algorithm>
#include <thread>
#include <utility>

#include "apps/simulate.hpp"
#include "datasets/acquisitions.hpp"

namespace credo::apps {
namespace {

/// Puts the rows of a simulation into `dataset`, and its images into `images`, with a nameless row for each.
sim::Sink sink_into(datasets::Dataset& dataset, std::vector<sensors::OmniImage>& images,
                    const std::function<void(double)>& progress) {
  return {
      .image =
          [&](const sensors::OmniImage& image) {
            images.push_back({image.time, image.pixels.clone()});
            dataset.images.push_back({image.time, {}});
          },
      .scan =
          [&](const sensors::RangeScan& scan) { dataset.scans[static_cast<std::size_t>(scan.sensor)].push_back(scan); },
      .sonar =
          [&](const sensors::SonarSweep& sweep) {
            dataset.sonar[static_cast<std::size_t>(sweep.sensor)].push_back(sweep);
          },
      .odometry = [&](const sensors::OdometryReading& reading) { dataset.odometry.push_back(reading); },
      .truth =
          [&](sensors::Timestamp time, const geometry::Pose2& pose) {
            dataset.truth.push_back({time, pose});
          },
      .verticals = {},
      .event =
          [&](sensors::Timestamp time, std::string_view name) {
            dataset.events.push_back({time, std::string(name)});
          },
      .progress = progress};
}

/// A dataset of the simulation without a row.
datasets::Dataset empty_dataset(const sim::Simulation& simulation) {
  datasets::Dataset dataset;
  dataset.header = header_of(simulation);
  const sensors::Rig& rig = dataset.header.rig;
  dataset.events_recorded = true;
  if (rig.camera) dataset.camera_name = "camera0";
  dataset.scans.resize(rig.range_finders.size());
  dataset.sonar.resize(rig.sonar_rings.size());
  for (std::size_t i = 0; i < rig.range_finders.size(); ++i)
    dataset.range_finder_names.push_back("range" + std::to_string(i));
  for (std::size_t i = 0; i < rig.sonar_rings.size(); ++i)
    dataset.sonar_ring_names.push_back("sonar" + std::to_string(i));
  return dataset;
}

/// The image of the acquisition's time, which the camera defines, or the nearest one.
const sensors::OmniImage* nearest_image(const std::vector<sensors::OmniImage>& images, sensors::Timestamp time) {
  const auto nearest = std::min_element(images.begin(), images.end(), [time](const auto& a, const auto& b) {
    return std::abs(a.time - time) < std::abs(b.time - time);
  });
  const sensors::Timestamp within = sensors::from_seconds(datasets::AcquisitionParams{}.nearest_within_s);
  return nearest != images.end() && std::abs(nearest->time - time) <= within ? &*nearest : nullptr;
}

}  // namespace

PlayedDrive play(const sim::World& world, std::uint64_t seed, const std::function<void(double)>& progress) {
  const sim::Simulation simulation(world, seed);
  PlayedDrive drive{empty_dataset(simulation), {}};
  std::vector<sensors::OmniImage> images;
  simulation.run(sink_into(drive.dataset, images, progress),
                 static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
  const datasets::Acquisitions acquisitions(drive.dataset);
  for (std::size_t i = 0; i < acquisitions.size(); ++i) {
    sensors::Acquisition& acquisition = drive.acquisitions.emplace_back(acquisitions.read(i));
    if (const sensors::OmniImage* image = nearest_image(images, acquisition.time)) acquisition.image = *image;
  }
  return drive;
}

}  // namespace credo::apps
