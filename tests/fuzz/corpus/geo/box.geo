SetFactory("OpenCASCADE");
h = 1; // size
For k In {0:1}
  Box(k + 1) = {0, 0, k, 1, 1, 1};
EndFor
If (h > 0.5)
  Mesh.MeshSizeMin = h; Mesh.MeshSizeMax = h;
EndIf
Physical Volume("tissue") = {1, 2};
