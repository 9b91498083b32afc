#pragma once

#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>

#include "hlc_bridge/dds/endpoint_qos.hpp"

/// Our quality of service in the library's words. Only sources of this folder include this file.
namespace hlc {

[[nodiscard]] eprosima::fastdds::dds::DataWriterQos writer_qos(const EndpointQos& qos);
[[nodiscard]] eprosima::fastdds::dds::DataReaderQos reader_qos(const EndpointQos& qos);

}  // namespace hlc
