# Fig. 10: first replicas; 2 contacts over grains, walls not counted (dashed in (b): counted).
load 'style.gp'
load 'rise.gp'
unset offsets
set multiplot
set ylabel 'coordination number {/:Italic Z}' offset 1.5
set xrange [10:*<20]
set yrange [0:*]
set offsets 0, 0, graph 0.15, 0
set lmargin at screen 0.07
set rmargin at screen 0.485
set label 1 '(a)' at graph 0.03, 0.94
set key right top
here(mu) = (strcol(cycles_mu_wall) eq mu && column(cycles_replicate) == 1) ? column(cycles_T) : NaN
fine(mu) = (strcol(cycle_mu_wall) eq mu && column(cycle_replicate) == 1) ? column(cycle_T) : NaN
plot cycles using (here('0')):(column(cycles_coordination)) with lines linewidth 1.2 linecolor rgb orange title '{/Symbol m}_{wall} = 0', \
     cycles using (here('0.5')):(column(cycles_coordination)) with lines linewidth 1.4 linecolor rgb blue title '{/Symbol m}_{wall} = 0.5'
set lmargin at screen 0.575
set rmargin at screen 0.985
set label 1 '(b)'
set xrange [10:11]
plot 1 with lines linewidth 1 dashtype '.' linecolor rgb grey, \
     cycle using (fine('0')):(column(cycle_coordination)) with lines linewidth 1.2 linecolor rgb orange title '{/Symbol m}_{wall} = 0', \
     cycle using (fine('0.5')):(column(cycle_coordination)) with lines linewidth 1.8 linecolor rgb blue title '{/Symbol m}_{wall} = 0.5', \
     cycle using (fine('0.5')):(column(cycle_coordination_with_walls)) with lines linewidth 1.4 dashtype '-' linecolor rgb blue title '{/Symbol m}_{wall} = 0.5, with walls'
unset multiplot
