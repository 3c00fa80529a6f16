// A quarter of a limb under a probe: a half (y >= 0) of its section, from the probe's middle (z = 0) along the limb. Skin, muscle and bone are circles whose
// centres stand so that the tissue has one thickness in front (towards the probe, along x) and another behind. Units: mm.
girth = 530;                  // round the skin
front_fat = 10.88; front_muscle = 30.92;    // fat: with the skin, which is a membrane on its surface
back_fat = 11.03; back_muscle = 54.57;
probe = 14.66;                // radius of what presses
cells = 8;                    // of quadratic tetrahedra over the probe's radius, at its edge; all others go with them
half_length = 120;

R = girth / (2 * Pi);
Rm = R - (front_fat + back_fat) / 2; xm = (back_fat - front_fat) / 2;
front = front_fat + front_muscle; back = back_fat + back_muscle;
Rb = R - (front + back) / 2; xb = (back - front) / 2;

Point(1) = {0, 0, 0}; Point(2) = {xm, 0, 0}; Point(3) = {xb, 0, 0};
Point(10) = {R, 0, 0}; Point(11) = {0, R, 0}; Point(12) = {-R, 0, 0};
Point(20) = {xm + Rm, 0, 0}; Point(21) = {xm, Rm, 0}; Point(22) = {xm - Rm, 0, 0};
Point(30) = {xb + Rb, 0, 0}; Point(31) = {xb, Rb, 0}; Point(32) = {xb - Rb, 0, 0};
Circle(1) = {10, 1, 11}; Circle(2) = {11, 1, 12};
Circle(3) = {20, 2, 21}; Circle(4) = {21, 2, 22};
Circle(5) = {30, 3, 31}; Circle(6) = {31, 3, 32};
Line(10) = {20, 10}; Line(12) = {22, 12};
Line(20) = {30, 20}; Line(22) = {32, 22};
Curve Loop(1) = {10, 1, 2, -12, -4, -3}; Plane Surface(1) = {1};
Curve Loop(2) = {20, 3, 4, -22, -6, -5}; Plane Surface(2) = {2};
fat[] = Extrude {0, 0, half_length} { Surface{1}; };
muscle[] = Extrude {0, 0, half_length} { Surface{2}; };
Physical Volume("fat") = {fat[1]};
Physical Volume("muscle") = {muscle[1]};
Physical Surface("skin") = {fat[3], fat[4]};
Physical Surface("bone") = {muscle[6], muscle[7]};
Physical Surface("middle") = {1, 2};
Physical Surface("end") = {fat[0], muscle[0]};
Physical Surface("half") = {fat[2], fat[5], muscle[2], muscle[5]};

// Cells grow with the distance from the probe's edge. They bend round the bone, and so are short beside its radius there, and are at most three times as long as the thinner fat.
fine = probe / cells;
coarse = 160 / cells;
thin = front_fat < back_fat ? front_fat : back_fat;
longest = 3 * thin < coarse ? 3 * thin : coarse;
Field[1] = MathEval;
Field[1].F = Sprintf("min(min(%g, 0.7 * %g + 0.5 * abs(sqrt((%g - x)^2 + y^2) - %g)), %g * (1 + %g * sqrt((sqrt(y^2 + z^2) - %g)^2 + (x - %g)^2)))",
                     longest, Rb, xb, Rb, fine, 3.2 / probe, probe, R);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
