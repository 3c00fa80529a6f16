// gmsh keeps one global model; a session owns it for as long as it lives.
#pragma once

namespace snug::mesh {

/// Starts gmsh quietly, without reading the user's configuration, and ends it on destruction. One at a time.
class GmshSession {
 public:
  GmshSession();
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;
};

}  // namespace snug::mesh
