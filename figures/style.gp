# Shared by all figures. Colours by Okabe & Ito (2008), told apart by the colour blind; marker shape
# repeats what colour says. Filled marks are steady points; open ones are not (see each legend).
blue = '#0072B2'; orange = '#E69F00'; green = '#009E73'; vermillion = '#D55E00'
grey = '#777777'; light = '#BBBBBB'

set border linewidth 1
set tics scale 0.7
set grid linecolor rgb '#E6E6E6' linewidth 0.6 linetype 1
set key noautotitle samplen 2 spacing 1.15
set bars 0.4

# One style of points for each canonical system: circle, square, triangle, diamond.
array systems[4] = ['2D smooth', '2D rough', '3D smooth', '3D rough']
array colours[4] = [blue, vermillion, green, orange]
array filled[4] = [7, 5, 9, 13]
array open[4] = [6, 4, 8, 12]

# `value` where a row belongs to system s and is steady (or is not), nothing elsewhere.
steady(s, value) = (strcol(points_system) eq systems[s] && strcol(points_state) eq 'steady') ? value : NaN
marked(s, value) = (strcol(points_system) eq systems[s] && strcol(points_state) ne 'steady') ? value : NaN
