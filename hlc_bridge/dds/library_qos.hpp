#pragma once

#include "hlc_bridge/dds/endpoint_qos.hpp"
#include "hlc_bridge/dds/fast_dds.hpp"

/// Our quality of service as the library's. Only sources of this folder include this file.
namespace hlc::dds {

[[nodiscard]] fdds::DataWriterQos writer_qos(const EndpointQos& qos);
[[nodiscard]] fdds::DataReaderQos reader_qos(const EndpointQos& qos);

}  // namespace hlc::dds
