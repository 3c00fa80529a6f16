// Two blocks of 40 x 40 x 30 mm, one on the other; their meshes do not match. Units: mm.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 40, 40, 30};
Box(2) = {0, 0, 30, 40, 40, 30};
Physical Volume("lower block") = {1};
Physical Volume("upper block") = {2};
Physical Surface("x sides") = {1, 2, 7, 8};
Physical Surface("y sides") = {3, 4, 9, 10};
Physical Surface("bottom") = {5};
Physical Surface("face below") = {6};
Physical Surface("face above") = {11};
Physical Surface("lid") = {12};
MeshSize{ PointsOf{ Volume{1}; } } = 14;
MeshSize{ PointsOf{ Volume{2}; } } = 10;
