// A tube of 20 to 55 mm, 60 mm long, in millimetres: gmsh meshes it with curved tetrahedra when the case is read.
SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 60, 55};
Cylinder(2) = {0, 0, 0, 0, 0, 60, 20};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

lower() = Surface In BoundingBox {-56, -56, -0.1, 56, 56, 0.1};
upper() = Surface In BoundingBox {-56, -56, 59.9, 56, 56, 60.1};
bone() = Surface In BoundingBox {-21, -21, -0.1, 21, 21, 60.1};
skin() = Surface {:};
skin() -= {lower(), upper(), bone()};

Physical Volume("tissue") = {3};
Physical Surface("skin") = skin();
Physical Surface("bone") = bone();
Physical Surface("lower") = lower();
Physical Surface("upper") = upper();

Mesh.MeshSizeMax = 14;
Mesh.ElementOrder = 2;
