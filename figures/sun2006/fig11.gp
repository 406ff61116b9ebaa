# Fig. 11: seen from the side; width and colour of an edge by its force, on one scale for both beds (it
# ends where a few outliers with wall friction lie beyond). Dots: centres of grains.
load 'style.gp'
set multiplot layout 1, 2
set palette defined (0 '#fde725', 0.3 '#28ae80', 0.65 '#2c728e', 1 '#472d7b')
stats edges using (strcol(edges_mu_wall) eq '0.5' ? column(edges_normal_force) : NaN) nooutput name 'force'
top = force_up_quartile + 6 * (force_up_quartile - force_median)
set cbrange [0:top]
set cblabel '{/:Italic F}_n  [{/:Italic m}_0 {/:Italic g}]'
set size ratio -1
unset grid
set key off
stats grains using (column(grains_x)) nooutput name 'x'
set xrange [x_min - 1:x_max + 1]
set xtics 5
set xlabel '{/:Italic x}/{/:Italic d}_0'
# Five widths.
class(force) = force < top ? int(5 * force / top) + 1 : 5
array mu[2] = ['0.5', '0']
stats grains using (strcol(grains_mu_wall) eq '0' ? 1 : 0) nooutput name 'smooth'
if (smooth_sum == 0) { set label '(b)  {/Symbol m}_{wall} = 0: not computed' at screen 0.75, 0.5 center }
do for [k = 1:(smooth_sum > 0 ? 2 : 1)] {
  stats edges using (strcol(edges_mu_wall) eq '0.5' ? column(edges_z_i) : NaN) nooutput name 'z'
  stats grains using (strcol(grains_mu_wall) eq mu[k] ? column(grains_z) : NaN) nooutput name 'own'
  set yrange [own_min - 1:own_min + (z_max - z_min) + 2]
  set ylabel (k == 1 ? '{/:Italic z}/{/:Italic d}_0' : '')
  set title sprintf('(%s)  {/Symbol m}_{wall} = %s', 'ab'[k:k], mu[k])
  if (k == 1 && smooth_sum > 0) { unset colorbox } else { set colorbox }
  own(name, value) = strcol(name) eq mu[k] ? value : NaN
  plot grains using (own(grains_mu_wall, column(grains_radius) < 1 ? column(grains_x) : NaN)):(column(grains_z)) with points pointtype 7 pointsize 0.12 linecolor rgb light, \
       for [w = 1:5] edges using (own(edges_mu_wall, class(column(edges_normal_force)) == w ? column(edges_x_i) : NaN)):(column(edges_z_i)):(column(edges_x_j) - column(edges_x_i)):(column(edges_z_j) - column(edges_z_i)):(column(edges_normal_force)) \
         with vectors nohead linewidth (0.2 + 0.6 * w) linecolor palette, \
       grains using (own(grains_mu_wall, column(grains_radius) > 1 ? column(grains_x) : NaN)):(column(grains_z)):(column(grains_radius)) with circles fillstyle transparent solid 0.35 border linecolor rgb vermillion
}
unset multiplot
