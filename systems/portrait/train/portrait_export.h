#pragma once
#include "export/exported_function.h"
#include "export/run_export.h"
#include "systems/portrait/train/portrait_network.h"

#include <filesystem>

namespace daumier::portrait {

/// crop (B, 3, R, R), colours 0 .. 1 -> coefficients (B, 239), expression weights of kUnit in 0 .. 1.
exporting::ExportedFunction PortraitFunction(PortraitNetwork network);

/// The network of shipped weights, without their numbers. network: NetworkToJson. @throws Error as
/// PortraitNetworkFromJson.
exporting::NetworkFunction MakePortraitNetwork(const Json& network);

/// The export of a finished run: the network as a graph, and its 3DMM. @throws Error as LoadPortraitRun.
exporting::RunExport DescribePortraitExport(const std::filesystem::path& run_directory);

}  // namespace daumier::portrait
