# Fig. 2: the plane y = 0 through the beds at T = 0. Each grain that it meets is drawn by the circle in
# which it does; the large grain has id 0.
load 'style.gp'
set style fill solid 1 border rgb '#555555'
set size ratio -1
set xlabel '{/:Italic x}/{/:Italic d}_0'
set ylabel '{/:Italic z}/{/:Italic d}_0'
set key off
unset grid
section(r, y) = r > abs(y) ? sqrt(r * r - y * y) : NaN
stats beds using (column(beds_small_grains)) nooutput name 'count'
stats beds using (column(beds_initial_height)) nooutput name 'height'
beds_shown = int(count_records)
array shown[2] = [sprintf('%g', count_min), sprintf('%g', count_max)]
array tall[2] = [height_min, height_max]
stats grains using (column(grains_x)) nooutput name 'x'
stats grains using (column(grains_z)) nooutput name 'z'
set yrange [-1:z_max + 2]
set xrange [x_min - 1:x_max + 1]
set xtics 5
set multiplot layout 1, beds_shown
do for [k = 1:beds_shown] {
  set title sprintf("%s small grains,\nheight %.1f {/:Italic d}_0", shown[k], tall[k])
  plot grains using (strcol(grains_small_grains) eq shown[k] && column(grains_id) > 0 ? column(grains_x) : NaN):(column(grains_z)):(section(column(grains_radius), column(grains_y))) with circles fillcolor rgb '#BBBBBB', \
       grains using (strcol(grains_small_grains) eq shown[k] && column(grains_id) == 0 ? column(grains_x) : NaN):(column(grains_z)):(section(column(grains_radius), column(grains_y))) with circles fillcolor rgb orange
}
unset multiplot
