# Fig. 9: first replica; heights over the base's mean height. Dotted: where the base's acceleration is
# -g, and T = 10.85, where the paper sees the bed land.
load 'style.gp'
load 'rise.gp'
unset offsets
stats beds using (column(beds_V_p)) nooutput name 'V_p'
set multiplot
set xrange [10:11]
set yrange [*:*]
set lmargin at screen 0.07
set rmargin at screen 0.485
set label 1 '(a)' at graph 0.93, 0.06
set offsets 0, 0, graph 0.25, 0
set arrow 1 from first 10.05, graph 0 to first 10.05, graph 1 nohead dashtype '.' linecolor rgb grey
set arrow 2 from first 10.85, graph 0 to first 10.85, graph 1 nohead dashtype '.' linecolor rgb grey
here(value) = column(cycle_replicate) == 1 ? value : NaN
set ylabel 'height  [{/:Italic d}_0]'
plot cycle using (column(cycle_T)):(here(column(cycle_large_height))) with lines linewidth 1.8 linecolor rgb blue title 'large grain', \
     cycle using (column(cycle_T)):(here(column(cycle_small_height))) with lines linewidth 1.8 linecolor rgb vermillion title 'centre of mass of small grains', \
     cycle using (column(cycle_T)):(here(column(cycle_base_height))) with lines linewidth 1.2 dashtype '-' linecolor rgb grey title 'base'
set lmargin at screen 0.58
set rmargin at screen 0.985
set label 1 '(b)' at graph 0.93, 0.06
set offsets 0, 0, graph 0.3, 0
set ylabel 'velocity  [({/:Italic g d}_0)^{1/2}]' offset 0
plot cycle using (column(cycle_T)):(here(column(cycle_large_velocity))) with lines linewidth 1.8 linecolor rgb blue title 'large grain', \
     cycle using (column(cycle_T)):(here(column(cycle_small_velocity))) with lines linewidth 1.8 linecolor rgb vermillion title 'centre of mass', \
     cycle using (column(cycle_T)):(V_p_max * cos(2 * pi * column(cycle_T))) with lines linewidth 1.2 dashtype '-' linecolor rgb grey title 'base'
unset multiplot
